// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Gathering, shooting and the matrix of form factors agree on ten small scenes.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <iostream>
#include <map>
#include <string>

#include "io/base/statistics.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

using Facing = SceneBuilder::Facing;

constexpr int bounces = 4;

struct Small {
  std::string name;
  Scene scene;
  std::vector<IntervalLight> light;
  double max_edge_m = 1.5;
};

void add_ground(SceneBuilder& builder, Change change, double half_m) {
  const int ground = builder.material({"ground", change(0.4), 0, 0});
  builder.object("ground").quad({-half_m, -half_m, 0}, {half_m, -half_m, 0}, {half_m, half_m, 0},
                                {-half_m, half_m, 0}, ground);
}

Scene corner(Change change) {
  SceneBuilder builder;
  add_ground(builder, change, 2);
  builder.object("wall").quad({2, 2, 0}, {2, -2, 0}, {2, -2, 3}, {2, 2, 3},
                              builder.material({"wall", change(0.7), 0, 0}));
  return builder.scene();
}

Scene canyon(Change change, double width_m, double height_m) {
  SceneBuilder builder;
  const int road = builder.material({"road", change(0.3), 0, 0});
  const int wall = builder.material({"wall", change(0.7), 0, 0});
  const double w = width_m / 2;
  builder.object("road").quad({-3, -w, 0}, {3, -w, 0}, {3, w, 0}, {-3, w, 0}, road);
  builder.object("north").quad({-3, w, 0}, {3, w, 0}, {3, w, height_m}, {-3, w, height_m}, wall);
  builder.object("south").quad({3, -w, 0}, {-3, -w, 0}, {-3, -w, height_m}, {3, -w, height_m},
                               wall);
  return builder.scene();
}

Scene box_on_ground(Change change) {
  SceneBuilder builder;
  add_ground(builder, change, 4);
  builder.object("box").box({-1, -1, 0.01}, {1, 1, 2}, builder.material({"box", change(0.6), 0, 0}),
                            Facing::outward);
  return builder.scene();
}

Scene changed_court(Change change) {
  SceneBuilder builder;
  add_ground(builder, change, 3);
  const int wall = builder.material({"wall", change(0.65), 0, 0});
  builder.object("west").box({-4, -3, 0.01}, {-3, 3, 3}, wall, Facing::outward);
  builder.object("east").box({3, -3, 0.01}, {4, 3, 2}, wall, Facing::outward);
  builder.object("north").box({-4, 3, 0.01}, {4, 4, 4}, wall, Facing::outward);
  return builder.scene();
}

Scene table(Change change) {
  SceneBuilder builder;
  add_ground(builder, change, 3);
  builder.sides(Sides::two)
      .object("top")
      .quad({-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1},
            builder.material({"top", change(0.5), 0, 0}));
  return builder.scene();
}

Scene glowing_room(Change change) {
  SceneBuilder builder;
  builder.object("room").box({0, 0, 0}, {3, 2, 1}, builder.material({"wall", change(0.6), 0, 1}),
                             Facing::inward);
  builder.object("cube").box({1, 0.5, 0.2}, {1.6, 1.1, 0.7},
                             builder.material({"cube", change(0.5), 0, 20}), Facing::outward);
  return builder.scene();
}

Scene wedge(Change change) {
  SceneBuilder builder;
  const int grey = builder.material({"grey", change(0.6), 0, 0});
  builder.object("low").quad({0, -2, 0}, {4, -2, 0}, {4, 2, 0}, {0, 2, 0}, grey);
  builder.object("steep").quad({0, -2, 0}, {0, 2, 0}, {2, 2, 2.5}, {2, -2, 2.5}, grey);
  return builder.scene();
}

/// Under a parallel source, with a sensor.
Scene beamed_court(Change change) {
  Scene scene = changed_court(change);
  add_parallel_source(scene, {-4, -7, 9}, {0, 6, -4}, {11, 0, 0}, 400);
  scene.sensors = {sensor_at({0, 0, 1.5}, {0, 1, 0}), sensor_at({-1, 1, 0}, {0, 0, 1})};
  return scene;
}

std::vector<Small> ten_scenes(Change change) {
  const auto suns = numbered_suns();
  return {{"corner", corner(change), suns},
          {"canyon", canyon(change, 3, 4), suns},
          {"narrow canyon", canyon(change, 1, 5), suns},
          {"box on ground", box_on_ground(change), suns, 2},
          {"court", changed_court(change), suns, 2},
          {"table", table(change), suns},
          {"glowing room", glowing_room(change), {night}, 1},
          {"lamp room", lamp_room(change), {night}, 1.5},
          {"wedge", wedge(change), suns},
          {"court under a beam", beamed_court(change), suns, 2}};
}

Solved solved_by(Transport transport, const Small& small) {
  SolverRules rules = test_rules();
  rules.lines_per_patch = 16 * 32;
  rules.bounces = bounces;
  rules.transport = transport;
  rules.seed = 1 + static_cast<std::uint64_t>(transport);  // no line in common
  return solve(small.scene, small.light, rules, {.max_edge_m = small.max_edge_m});
}

/// One quantity by two transports.
struct MatrixComparison {
  std::string what;
  SampleMean a, b;
  double bias = 0;  ///< bound of that by lines that are used again
  double difference() const { return b.mean - a.mean; }
  double limit(double t) const { return t * std::hypot(a.se, b.se) + bias; }
};

/// Mean irradiance of an object, or of a sensor, of every realization; and of the series.
struct Quantity {
  std::string name;
  std::vector<double> realizations;
  double series = 0;

  /// Realizations have R times the bias of all lines pooled.
  double reuse() const {
    const auto R = static_cast<double>(realizations.size());
    return std::abs(sample_mean(realizations).mean - series) * R / (R - 1);
  }
};

/// Of the chosen patches, all light or what is reflected.
Quantity mean_over(const Solved& solved, Part part, std::string name,
                   const std::function<bool(std::size_t)>& chosen) {
  const auto p = static_cast<std::size_t>(part);
  const auto& realizations =
      part == Part::total ? solved.tally.exposure_realization : solved.tally.part_realization[p];
  double area = 0;
  Quantity mean{std::move(name), std::vector<double>(realizations.size(), 0)};
  for (std::size_t i = 0; i < solved.area.size(); ++i) {
    if (!chosen(i)) continue;
    area += solved.area[i];
    mean.series += solved.area[i] * solved.tally.exposure[p][i];
    for (std::size_t r = 0; r < realizations.size(); ++r)
      mean.realizations[r] += solved.area[i] * realizations[r][i];
  }
  if (area == 0) return {};
  mean.series /= area;
  for (double& E : mean.realizations) E /= area;
  return mean;
}

std::vector<Quantity> quantities(const Scene& scene, const Solved& solved) {
  std::vector<Quantity> all;
  for (std::size_t o = 0; o < scene.mesh.object_names.size(); ++o) {
    const auto chosen = [&](std::size_t i) {
      return scene.mesh.triangle_object[static_cast<std::size_t>(solved.patches[i].triangle)]
                 .index() == o;
    };
    const std::string& name = scene.mesh.object_names[o];
    for (Quantity& mean :
         std::array{mean_over(solved, Part::total, name, chosen),
                    mean_over(solved, Part::reflected, name + ", reflected", chosen)})
      if (!mean.realizations.empty()) all.push_back(std::move(mean));
  }
  for (std::size_t s = 0; s < scene.sensors.size(); ++s)
    all.push_back({"sensor " + std::to_string(s), of_sensor(solved.tally, s),
                   solved.tally.sensors.exposure[0][s]});
  return all;
}

/// Of everything by every pair of transports, and by gathering and a matrix of a scene with a
/// planted fault.
struct Families {
  std::vector<MatrixComparison> sound, faulty;
};

Families families(Change fault) {
  Families all;
  const auto scenes = ten_scenes(as_it_is), others = ten_scenes(fault);
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    const Scene& scene = scenes[s].scene;
    const auto gathered = quantities(scene, solved_by(Transport::gather, scenes[s]));
    const auto shot = quantities(scene, solved_by(Transport::shoot, scenes[s]));
    const auto matrix = quantities(scene, solved_by(Transport::matrix, scenes[s]));
    const auto faulty = quantities(scene, solved_by(Transport::matrix, others[s]));
    const auto of = [&](const Quantity& a, const Quantity& b, const char* pair) {
      return MatrixComparison{scenes[s].name + ", " + a.name + ", " + pair,
                              sample_mean(a.realizations), sample_mean(b.realizations),
                              a.reuse() + b.reuse() + float_rounding * a.series};
    };
    for (std::size_t q = 0; q < gathered.size(); ++q) {
      all.sound.push_back(of(gathered[q], shot[q], "gather and shoot"));
      all.sound.push_back(of(gathered[q], matrix[q], "gather and matrix"));
      all.sound.push_back(of(shot[q], matrix[q], "shoot and matrix"));
      all.faulty.push_back(of(gathered[q], faulty[q], "gather and a faulty matrix"));
    }
  }
  return all;
}

/// Level of the whole family (Bonferroni).
double family_t(const std::vector<MatrixComparison>& family) {
  constexpr double level = 0.01, degrees_of_freedom = 15;  // 16 realizations of either
  return student_t_quantile(1 - level / (2 * static_cast<double>(family.size())),
                            degrees_of_freedom);
}

TEST(Matrix, AgreesWithGatheringAndShootingOnTenScenes) {
  const Families both = families(squared);
  const double t = family_t(both.sound);
  for (const MatrixComparison& c : both.sound)
    EXPECT_LE(std::abs(c.difference()), c.limit(t)) << c.what << ": " << c.a.mean;
  std::map<std::string, int> noticed;
  for (const MatrixComparison& c : both.faulty) {
    int& of_scene = noticed[c.what.substr(0, c.what.find(','))];
    of_scene += std::abs(c.difference()) > c.limit(t);
  }
  EXPECT_EQ(noticed.size(), 10u);
  for (const auto& [scene, count] : noticed)
    EXPECT_GT(count, 0) << scene << ": planted fault: reflectance applied twice";
}

TEST(Matrix, FollowsAllReflectionsAtOnceAsManyBouncesDo) {
  const Small small{"court", changed_court(as_it_is), numbered_suns(), 2};
  SolverRules rules = test_rules();
  rules.transport = Transport::matrix;
  rules.bounces = 60;
  const SplitRules split{.max_edge_m = small.max_edge_m};
  const Solved counted = solve(small.scene, small.light, rules, split);
  rules.unfollowed = Unfollowed::estimate;
  rules.bounces = 1;
  const Solved at_once = solve(small.scene, small.light, rules, split);
  for (std::size_t i = 0; i < counted.area.size(); ++i) {
    const double E = counted.tally.exposure[0][i];
    EXPECT_NEAR(at_once.tally.exposure[0][i], E, float_rounding * E) << i;
    EXPECT_NEAR(mean_error(at_once.of_patch(i)).mean, mean_error(counted.of_patch(i)).mean,
                float_rounding * E);
  }
  for (const Ledger& ledger : at_once.tally.ledger) EXPECT_EQ(ledger[Term::unshot], 0);
  // Nothing is left over but what the lines to the sky and the ground do not know exactly.
  const auto residual = at_once.ledger([](const Ledger& l) { return l.residual() / l.in(); });
  EXPECT_TRUE(expect_mean(residual, 0)) << expect_mean(residual, 0).text;
}

}  // namespace
}  // namespace sunload::test
