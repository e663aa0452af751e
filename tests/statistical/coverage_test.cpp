// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Are the error bars right? Over many independent runs the share of 95 % intervals that
/// hold the truth must itself lie in its binomial interval.

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <functional>
#include <iostream>

#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

constexpr int runs = 600;
constexpr double level = 0.95;

SolverRules run_rules(std::uint64_t seed) {
  SolverRules rules = test_rules();
  rules.realizations = 8;
  rules.lines_per_patch = 8 * 32;
  rules.direct_samples = 8 * 16;
  rules.bounces = 3;
  rules.seed = seed;
  return rules;
}

/// Values per realization of one run.
using Run = std::function<std::vector<double>(const Solved&)>;
/// Half width of the interval from the values.
using Width = std::function<double(const std::vector<double>&)>;

double student_width(const std::vector<double>& values) {
  const boost::math::students_t student(static_cast<double>(values.size()) - 1);
  return quantile(complement(student, (1 - level) / 2)) * mean_error(values).standard_error;
}

double covered(const std::vector<std::vector<double>>& all, double truth, const Width& width) {
  double count = 0;
  for (const auto& values : all)
    count += std::abs(mean_error(values).mean - truth) <= width(values);
  return count;
}

/// Accepted with Student's intervals; refused where the variance stands for the standard
/// error, and where the spread of one realization does.
void expect_coverage(const std::string& name, const std::vector<std::vector<double>>& all,
                     double truth) {
  const CountInterval interval = accepted_counts(runs, level);
  const double count = covered(all, truth, student_width);
  std::cout << name << ": " << count << " of " << runs << " intervals hold the truth, accepted "
            << interval.low << " to " << interval.high << "\n";
  EXPECT_TRUE(interval.contains(count)) << count;
  EXPECT_FALSE(interval.contains(covered(all, truth, [](const auto& values) {
    const double width = student_width(values), error = mean_error(values).standard_error;
    return width * error;
  })));
  EXPECT_FALSE(interval.contains(covered(all, truth, [](const auto& values) {
    return student_width(values) * std::sqrt(static_cast<double>(values.size()));
  })));
}

std::vector<std::vector<double>> repeated(const Scene& scene, const IntervalLight& light,
                                          const SplitRules& split, const Run& of) {
  std::vector<std::vector<double>> all;
  for (int run = 0; run < runs; ++run)
    all.push_back(
        of(solve(scene, {light}, run_rules(1000 + static_cast<std::uint64_t>(run)), split)));
  return all;
}

// Lines: unit squares face to face, F = 0.19982489569839 (Howell C-11), no reflection back.
TEST(Coverage, OfAFormFactor) {
  SceneBuilder builder;
  const int black = builder.material({"black", 0, 0, 0}),
            lamp = builder.material({"lamp", 0, 0, 1});
  builder.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, black);
  builder.quad({0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}, lamp);
  constexpr double F = 0.19982489569839;
  expect_coverage(
      "form factor",
      repeated(builder.scene(), one_second({0, 0, -1}, 0), {},
               [](const Solved& s) {
                 return s.means([&](std::size_t i) { return s.patches[i].triangle < 2; });
               }),
      F);
}

// What a patch sees of the sky beside the same square: its halves are alike.
TEST(Coverage, OfASkyViewFactor) {
  SceneBuilder builder;
  const int black = builder.material({"black", 0, 0, 0});
  builder.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, black);
  builder.quad({0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}, black);
  constexpr double truth = 1 - 0.19982489569839;
  const boost::math::students_t student(run_rules(1).realizations - 1);
  const double t = quantile(complement(student, (1 - level) / 2));
  std::vector<Solved> all;
  for (int run = 0; run < runs; ++run)
    all.push_back(solve(builder.scene(), {one_second({0, 0, -1}, 0)},
                        run_rules(1000 + static_cast<std::uint64_t>(run))));
  const auto covered_by = [&](double width) {
    return static_cast<double>(std::count_if(all.begin(), all.end(), [&](const Solved& solved) {
      return std::abs(solved.sky_view[0] - truth) <= width * t * solved.sky_view_se[0];
    }));
  };
  const CountInterval interval = accepted_counts(runs, level);
  std::cout << "sky view: " << covered_by(1) << " of " << runs << " intervals hold the truth\n";
  EXPECT_TRUE(interval.contains(covered_by(1))) << covered_by(1);
  EXPECT_FALSE(interval.contains(covered_by(std::sqrt(run_rules(1).realizations))));
  EXPECT_FALSE(interval.contains(covered_by(1 / std::sqrt(run_rules(1).realizations))));
}

// Direct sun: the shadow line of a screen, which a fifth of the light passes by chance, halves a
// square askew, so that it cuts its patches at all angles. (Where it runs along the strata of the
// samples, few values are possible and intervals of 8 realizations of 16 samples hold the truth in
// some 85 % only.)
TEST(Coverage, OfAScreensShadow) {
  constexpr double passed = 0.2;
  constexpr double turn = 0.3, half = 2, middle = 3;
  const Vec3 x{half * std::cos(turn), half * std::sin(turn), 0}, y{-x.y, x.x, 0}, c{0, middle, 0};
  SceneBuilder builder;
  const int black = builder.material({"black", 0, 0, 0});
  builder.quad(c - x - y, c + x - y, c + x + y, c - x + y, black);
  const Vec3 sun = normalized({0.3, -1, 0.8});
  const double height = middle * sun.z / -sun.y;  // its shadow ends at the middle
  const int screen = builder.material({.name = "screen", .transmittance = passed});
  builder.sides(Sides::two)
      .object("wall")
      .quad({-6, 0, 0}, {6, 0, 0}, {6, 0, height}, {-6, 0, height}, screen);
  expect_coverage(
      "shadow",
      repeated(builder.scene(), one_second(sun, 1), {.max_edge_m = 3},
               [](const Solved& s) {
                 return s.means([&](std::size_t i) { return s.patches[i].triangle < 2; });
               }),
      sun.z * (1 + passed) / 2);
}

/// Area-weighted mean of one part over the chosen patches, per realization.
std::vector<double> means_of_part(const Solved& solved, Part part,
                                  const std::function<bool(std::size_t)>& chosen) {
  std::vector<double> means;
  for (const auto& of_realization : solved.tally.part_realization[static_cast<std::size_t>(part)]) {
    double sum = 0, area = 0;
    for (std::size_t i = 0; i < of_realization.size(); ++i) {
      if (!chosen(i)) continue;
      sum += solved.area[i] * of_realization[i];
      area += solved.area[i];
    }
    means.push_back(sum / area);
  }
  return means;
}

// Glints alone: the image of an upright mirror lies across the patches of a floor, all of it. Some
// light passes the mirror, by chance, so that rays tell of it: of others geometry does, exactly.
TEST(Coverage, OfGlints) {
  constexpr double half = 6, width = 1, height = 1.3, rho = 0.8, turn = 0.3;
  SceneBuilder builder;
  const int black = builder.material({"black", 0, 0, 0}),
            mirror = builder.material({.name = "mirror", .mirror = rho, .transmittance = 0.1});
  builder.quad({-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}, black);
  const Vec3 along{std::cos(turn), std::sin(turn), 0}, up{0, 0, height}, foot{0, 0, 0.5};
  const Vec3 normal = normalized(cross(along, up));
  builder.object("mirror").quad(foot - along * (width / 2), foot + along * (width / 2),
                                foot + along * (width / 2) + up, foot - along * (width / 2) + up,
                                mirror);
  const Vec3 sun = normalized({0.2, -0.8, 0.7});
  expect_coverage("glints",
                  repeated(builder.scene(), one_second(sun, 1), {.max_edge_m = 3},
                           [](const Solved& s) {
                             return means_of_part(s, Part::mirror, [&](std::size_t i) {
                               return s.patches[i].triangle < 2;
                             });
                           }),
                  rho * dot(normal, sun) * width * height / (4 * half * half));
}

// Sun, sky, reflection and a mirror together: the ledger's residual is zero.
TEST(Coverage, OfTheLedgersResidual) {
  SceneBuilder builder;
  const int wall = builder.material({"wall", 0.5, 0, 0}),
            glass = builder.material({"glass", 0.1, 0.6, 0});
  builder.object("ground").quad({-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}, wall);
  builder.object("house").box({-2, 1, 0.01}, {2, 2, 2}, wall, SceneBuilder::Facing::outward);
  builder.object("glass").quad({-1.5, 0.99, 0.5}, {1.5, 0.99, 0.5}, {1.5, 0.99, 1.5},
                               {-1.5, 0.99, 1.5}, glass);
  auto light = with_uniform_sky(one_second({0.3, -0.8, 0.5}, 600), 100);
  light.ground_exitance = 60;
  expect_coverage("residual",
                  repeated(builder.scene(), light, {},
                           [](const Solved& s) {
                             return s.ledger([](const Ledger& l) { return l.residual(); });
                           }),
                  0);
}

}  // namespace
}  // namespace sunload::test
