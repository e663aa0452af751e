// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Emitters sampled directly: exact where the answer is known, quiet where lines are not.

#include "solver/lines/bright_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "solver/gather/block_light.h"
#include "solver/gather/jacobi.h"
#include "solver/mesh/push_pull.h"
#include "tests/support/known_truth.h"
#include "tests/support/reference.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

using Facing = SceneBuilder::Facing;

constexpr double exitance = 50;

/// Irradiance by emitters of one scene [realization][patch], and what lines alone say of it.
struct ByLamps {
  ByLamps(const Scene& scene, const SplitRules& split, int lines_per_realization)
      : traced(trace_scene(scene, split, diffuse_rules(lines_per_realization, 0, 32), watch)) {
    const auto optics = patch_optics(scene, traced->hierarchy());
    std::vector<double> emission(optics.emission.begin(), optics.emission.end());
    emission.resize(traced->hierarchy().element_count());
    pull_up(traced->hierarchy(), emission);
    const SolverRules& rules = traced->rules;
    const auto plain = trace_lines(
        scene, traced->hierarchy(), traced->caster, traced->grid, {},
        {rules.lines_per_patch, {}, rules.realizations, rules.mirror_depth, rules.seed, 0}, watch);
    for (std::size_t r = 0; r < plain.realizations.size(); ++r) {
      both.push_back(traced->patches.lines.realizations[r].lamps);
      lines.emplace_back(both.back().size());
      gather(plain.realizations[r].patches, emission, lines.back(), Into::replace);
    }
  }

  /// Power that all patches receive, per realization [W].
  std::vector<double> power(const std::vector<std::vector<double>>& irradiance) const {
    std::vector<double> sums;
    for (const auto& E : irradiance) {
      double sum = 0;
      for (std::size_t i = 0; i < E.size(); ++i) sum += traced->hierarchy().area()[i] * E[i];
      sums.push_back(sum);
    }
    return sums;
  }

  /// Mean over the area of the variance of one realization.
  double variance(const std::vector<std::vector<double>>& irradiance) const {
    double sum = 0, area = 0;
    for (std::size_t i = 0; i < traced->hierarchy().patch_count(); ++i) {
      std::vector<double> values;
      for (const auto& E : irradiance) values.push_back(E[i]);
      const double error = mean_error(values).standard_error;
      sum += traced->hierarchy().area()[i] * error * error * static_cast<double>(values.size());
      area += traced->hierarchy().area()[i];
    }
    return sum / area;
  }

  Watch watch;
  std::unique_ptr<const TracedScene> traced;
  std::vector<std::vector<double>> both, lines;
};

/// A closed room: what emitters send arrives.
SceneBuilder bright_room() {
  SceneBuilder builder;
  builder.box({0, 0, 0}, {4, 3, 2.5}, builder.material({"wall", 0.5, 0, 0}), Facing::inward);
  return builder;
}

void expect_power(const ByLamps& light, double truth) {
  constexpr double fault = 1.01;
  const auto received = light.power(light.both);
  const Verdict verdict = expect_mean(received, truth, float_rounding * truth);
  std::cout << verdict.text << "\n";
  EXPECT_TRUE(verdict) << verdict.text;
  EXPECT_FALSE(expect_mean(received, truth * fault, float_rounding * truth));
  // Planted fault: both strategies in full, without their weights.
  auto twice = light.power(light.lines);
  for (std::size_t r = 0; r < twice.size(); ++r) twice[r] += received[r];
  EXPECT_FALSE(expect_mean(twice, truth, float_rounding * truth));
}

TEST(Lamps, ASmallOneIsNotMissed) {
  SceneBuilder builder = bright_room();
  const int lamp = builder.material({"lamp", 0, 0, exitance});
  builder.object("lamp").quad({2, 1, 2.2}, {2, 1.1, 2.2}, {2.1, 1.1, 2.2}, {2.1, 1, 2.2}, lamp);
  builder.object("back").quad({2, 1, 2.21}, {2.1, 1, 2.21}, {2.1, 1.1, 2.21}, {2, 1.1, 2.21},
                              builder.material({"back", 0.2, 0, 0}));
  const ByLamps light(builder.scene(), {.max_edge_m = 0.7}, 32);
  expect_power(light, exitance * 0.01);
  const double gain = light.variance(light.lines) / light.variance(light.both);
  std::cout << "lamp of 1 dm2 in a room: variance by lines / with points = " << gain << "\n";
  // Of 32 lines of a patch of the floor, one in a hundred realizations sees the lamp at all.
  EXPECT_GT(gain, 300);
}

// Lamps of all kinds: in the corner of two walls, of two sides, behind a box, of many parts.
TEST(Lamps, TheirPowerArrives) {
  SceneBuilder builder = bright_room();
  const int wall = builder.material({"box", 0.3, 0, 0});
  const int lamp = builder.material({"lamp", 0.1, 0, exitance});
  builder.object("box").box({1, 1, 0.001}, {2, 2, 1}, wall, Facing::outward);
  builder.object("corner").quad({0.001, 0, 0}, {0.001, 1, 0}, {0.001, 1, 1}, {0.001, 0, 1}, lamp);
  builder.object("cube").box({3, 2, 0.5}, {3.1, 2.1, 0.6}, lamp, Facing::outward);
  builder.sides(Sides::two)
      .object("sheet")
      .quad({2.5, 0.5, 1}, {3, 0.5, 1}, {3, 1, 1.5}, {2.5, 1, 1.5}, lamp);
  const double sheet = 0.5 * std::sqrt(0.5);
  const ByLamps light(builder.scene(), {.max_edge_m = 1.2}, 64);
  expect_power(light, exitance * (1 + 6 * 0.01 + 2 * sheet));
}

TEST(Lamps, MoreThanAPatchCanWeighOneByOne) {
  SceneBuilder builder = bright_room();
  const int lamp = builder.material({"lamp", 0, 0, exitance});
  constexpr int rows = 20;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < rows; ++j) {
      const double x = 0.1 + 3.8 * i / rows, y = 0.1 + 2.8 * j / rows;
      builder.object("lamp").quad({x, y, 2.4}, {x, y + 0.02, 2.4}, {x + 0.02, y + 0.02, 2.4},
                                  {x + 0.02, y, 2.4}, lamp);
    }
  const ByLamps light(builder.scene(), {.max_edge_m = 2}, 512);
  // Backs are black and receive too: all of it arrives on fronts all the same, as lamps hang
  // below a ceiling that sees their backs alone.
  expect_power(light, exitance * rows * rows * 0.0004);
  EXPECT_GT(light.variance(light.lines) / light.variance(light.both), 2);
}

/// Mean irradiance per realization of the triangles of one object.
std::vector<double> received(const ByLamps& light, const Scene& scene, std::size_t object) {
  std::vector<double> means;
  for (const auto& E : light.both) {
    double power = 0, area = 0;
    for (std::size_t i = 0; i < E.size(); ++i) {
      const auto t = static_cast<std::size_t>(light.traced->hierarchy().patches()[i].triangle);
      if (scene.mesh.triangle_object[t].index() != object) continue;
      power += light.traced->hierarchy().area()[i] * E[i];
      area += light.traced->hierarchy().area()[i];
    }
    means.push_back(power / area);
  }
  return means;
}

constexpr TruthCheck bright_check{.fault_factor = 1.02};

// Unit squares, one over the other at distance 1, lit by each other; and at a right angle,
// where both touch (reference 04).
TEST(Lamps, LightEachOtherThoughTheyTouch) {
  int cases = 0;
  for (const auto& c : reference_cases("04_form_factors/closed_forms.json")) {
    const auto& g = c["geometry"];
    if (!g.contains("P1") || !g.contains("P2")) continue;
    SceneBuilder builder;
    double largest = 0, rim = 0;
    std::size_t object = 0;
    std::vector<double> area;
    for (const char* name : {"P1", "P2"}) {
      const int lamp = builder.material({name, 0, 0, 1});
      std::vector<Vec3> p;
      for (const auto& v : g[name]) p.push_back({number(v[0]), number(v[1]), number(v[2])});
      builder.object(name);
      ++object;
      Vec3 twice_area;
      for (std::size_t k = 0; k < p.size(); ++k) {
        largest = std::max({largest, std::abs(p[k].x), std::abs(p[k].y), std::abs(p[k].z)});
        rim += norm(p[(k + 1) % p.size()] - p[k]);
        twice_area += cross(p[k] - p[0], p[(k + 1) % p.size()] - p[0]);
      }
      area.push_back(norm(twice_area) / 2);
      for (std::size_t k = 2; k < p.size(); ++k) builder.triangle(p[0], p[k - 1], p[k], lamp);
    }
    const ByLamps light(builder.scene(), {}, 4096);
    const double F = number(c["F12"]);
    // Lines start, and shadow rays end, 16 roundings above their surfaces: a rim of that width.
    const double bias = 2 * 16 * largest / (1 << 24) * rim / std::min(area[0], area[1]);
    bright_check(c["id"].get<std::string>() + " forth", received(light, builder.scene(), 1), F,
                 bias + float_rounding * F);
    bright_check(c["id"].get<std::string>() + " back", received(light, builder.scene(), 2),
                 F * area[0] / area[1], bias + float_rounding * F * area[0] / area[1]);
    // The same where what is lit fills most of the view: lines keep all of it.
    EXPECT_LE(light.variance(light.both), light.variance(light.lines)) << c["id"];
    ++cases;
  }
  EXPECT_GE(cases, 17);
}

// A mirror shows the receiver a lamp that it cannot see: as its image would.
TEST(Lamps, AreSeenInMirrors) {
  const auto scene = [](bool image) {
    SceneBuilder builder;
    const int black = builder.material({"black", 0, 0, 0});
    const int lamp = builder.material({"lamp", 0, 0, exitance});
    builder.object("receiver").quad({0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}, black);
    if (image) {
      builder.object("lamp").quad({2, 0, -1}, {3, 0, -1}, {3, 1, -1}, {2, 1, -1}, lamp);
      return builder;
    }
    builder.object("lamp").quad({2, 0, 1}, {2, 1, 1}, {3, 1, 1}, {3, 0, 1}, lamp);
    builder.object("mirror").quad({-20, -20, 0}, {20, -20, 0}, {20, 20, 0}, {-20, 20, 0},
                                  builder.material({"mirror", 0, 0.8, 0}));
    return builder;
  };
  const SceneBuilder by_mirror = scene(false), straight = scene(true);
  const ByLamps in_mirror(by_mirror.scene(), {}, 32768), image(straight.scene(), {}, 32768);
  const auto truth = mean_error(received(image, straight.scene(), 1));
  const double seen = 0.8 * truth.mean;
  bright_check(
      "lamp in a mirror", received(in_mirror, by_mirror.scene(), 1), seen,
      0.8 * accepted_t(in_mirror.both.size()) * truth.standard_error + float_rounding * seen);
}

/// Irradiance by surfaces of a radiosity that grows with height, from links alone.
std::vector<double> linked_power(const Lines& lines, const Hierarchy& mesh) {
  std::vector<double> radiosity(mesh.element_count(), 0), irradiance(mesh.patch_count());
  for (std::size_t i = 0; i < mesh.patch_count(); ++i) radiosity[i] = exitance * mesh.centroid(i).z;
  std::vector<double> sums;
  for (const auto& set : lines.realizations) {
    gather(set.patches, radiosity, irradiance, Into::replace);
    double sum = 0;
    for (std::size_t i = 0; i < irradiance.size(); ++i) sum += mesh.area()[i] * irradiance[i];
    sums.push_back(sum);
  }
  return sums;
}

// A guide may be wrong: it decides how noisy links are, not what they carry.
TEST(BrightSurfaces, LinksDoNotDependOnTheGuide) {
  SceneBuilder builder = bright_room();
  builder.object("box").box({1, 1, 0.5}, {2, 2, 1.5}, builder.material({"box", 0.3, 0, 0}),
                            Facing::outward);
  builder.object("screen").quad(
      {2.5, 0.5, 1}, {2.5, 2.5, 1}, {2.5, 2.5, 2}, {2.5, 0.5, 2},
      builder.material({.name = "screen", .diffuse = 0.4, .transmittance = 0.5}));
  const Scene& scene = builder.scene();
  const Hierarchy mesh(scene, {.max_edge_m = 1});
  const RayCaster caster(scene.mesh, "auto", screens(scene));
  const SkyGrid grid;
  Watch watch;
  const LineRules rules{.lines_per_patch = 32 * 64, .realizations = 32};
  const auto plain = linked_power(trace_lines(scene, mesh, caster, grid, {}, rules, watch), mesh);
  std::vector<double> guess(mesh.patch_count());
  for (std::size_t i = 0; i < guess.size(); ++i) guess[i] = static_cast<double>(mesh.key()[i] % 5);
  Guide guide{{scene, mesh, guess, 16}, {}, {}};
  guide.sight = ClusterSight(scene, mesh, caster, guide.surfaces, 1e5, 1);
  for (std::size_t i = 0; i < guess.size(); ++i)
    guide.lines_alone.push_back(0.25f * static_cast<float>(i % 5));
  const auto guided =
      linked_power(trace_lines(scene, mesh, caster, grid, guide, rules, watch), mesh);
  std::vector<double> difference, both;
  for (std::size_t r = 0; r < plain.size(); ++r) {
    difference.push_back(guided[r] - plain[r]);
    both.push_back(guided[r] - 1.01 * plain[r]);
  }
  const double rounding = float_rounding * mean_error(plain).mean;
  const Verdict verdict = expect_mean(difference, 0, rounding);
  EXPECT_TRUE(verdict) << verdict.text;
  EXPECT_FALSE(expect_mean(both, 0, rounding)) << "an error of one hundredth is found";
  EXPECT_LT(mean_error(guided).standard_error, 2 * mean_error(plain).standard_error);
}

// Emitted and received balance with diffuse reflection and light that leaves.
TEST(Lamps, CloseTheLedger) {
  SceneBuilder builder;
  const int wall = builder.material({"wall", 0.6, 0, 0});
  builder.object("ground").quad({-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}, wall);
  builder.object("wall").box({-3, 2, 0.01}, {3, 3, 4}, wall, Facing::outward);
  builder.object("glass").quad({-2, 1.99, 1}, {2, 1.99, 1}, {2, 1.99, 3}, {-2, 1.99, 3},
                               builder.material({"glass", 0.1, 0.6, 0}));
  builder.object("lamp").box({0, 0, 2}, {0.1, 0.1, 2.1},
                             builder.material({"lamp", 0.2, 0, exitance}), Facing::outward);
  SolverRules rules = test_rules();
  rules.bounces = 20;
  const auto solved = solve(builder.scene(), {one_second({0, 0, -1}, 0)}, rules, {.max_edge_m = 1});
  const auto in = solved.ledger([](const Ledger& l) { return l.in(); });
  const double emitted = exitance * 0.06;
  EXPECT_NEAR(mean_error(in).mean, emitted, float_rounding * emitted);
  const auto residual = solved.ledger([](const Ledger& l) { return l.residual(); });
  const Verdict verdict = expect_mean(residual, 0, float_rounding * emitted);
  EXPECT_TRUE(verdict) << verdict.text;
  EXPECT_LE(verdict.standard_error, 0.01 * emitted);
  const auto faulty =
      solved.ledger([](const Ledger& l) { return l.residual() - 0.3 * l[Term::absorbed]; });
  EXPECT_FALSE(expect_mean(faulty, 0, float_rounding * emitted));
}

}  // namespace
}  // namespace sunload::test
