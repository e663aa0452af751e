// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Parallel emitters: beams of known cross-section on plates, boxes and mirrors.

#include "solver/first_light/lamp_light.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/support/lamp_rules.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

using Facing = SceneBuilder::Facing;

constexpr double exitance = 300;

/// 4 m × 4 m about the z axis at a height of 5 m, shining down.
void add_lamp_above(Scene& scene) {
  add_parallel_source(scene, {-2, -2, 5}, {0, 4, 0}, {4, 0, 0}, exitance);
}

// Inside of the beam a plate gets M cosθ, with no error but rounding; outside nothing.
TEST(ParallelLight, OnATiltedPlateIsExact) {
  SceneBuilder builder;
  const int black = builder.material({"black", 0, 0, 0});
  const double tilt = 0.6;
  const Vec3 up{0, std::cos(tilt), std::sin(tilt)};
  const Vec3 p{-0.5, -0.5, 1};
  builder.object("inside").quad(p, p + Vec3{1, 0, 0}, p + Vec3{1, 0, 0} + up, p + up, black);
  builder.object("outside").quad({3, 0, 1}, {4, 0, 1}, {4, 1, 1}, {3, 1, 1}, black);
  builder.object("above").quad({-1, -1, 6}, {1, -1, 6}, {1, 1, 6}, {-1, 1, 6}, black);
  Scene scene = builder.scene();
  add_lamp_above(scene);
  const auto solved = solve(scene, {night}, lamp_rules(0), {.max_edge_m = 0.4});
  int inside = 0;
  for (std::size_t i = 0; i < solved.area.size(); ++i) {
    const auto E = static_cast<double>(solved.tally.irradiance[lamps][i]);
    const bool lit = solved.patches[i].triangle < 2;
    inside += lit;
    const double truth = lit ? exitance * std::cos(tilt) : 0;
    ASSERT_NEAR(E, truth, float_rounding * exitance) << i;
    ASSERT_NEAR(solved.tally.exposure_realization[3][i], truth, float_rounding * exitance);
  }
  EXPECT_GT(inside, 8);
  EXPECT_NEAR(solved.tally.ledger[0][Term::emitted], exitance * std::cos(tilt),
              float_rounding * exitance);
}

// Both triangles of a source have the edge between them.
TEST(ParallelLight, OnTheSeamOfItsTrianglesIsThatOfOne) {
  SceneBuilder builder;
  const int black = builder.material({"black", 0, 0, 0});
  builder.object("ground").quad({-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, black);
  Scene scene = builder.scene();
  add_lamp_above(scene);
  for (const double d : {-1.5, -0.3, 0.0, 0.7, 1.1}) {
    scene.sensors.push_back(sensor_at({d, d, 0}, {0, 0.6, 0.8}));
    scene.sensors.push_back(sensor_at({d, -d, 0}, {0, 0.6, 0.8}));
  }
  const auto solved = solve(scene, {night}, lamp_rules(0), {});
  for (std::size_t s = 0; s < scene.sensors.size(); ++s)
    EXPECT_NEAR(solved.tally.sensors.exposure[lamps][s], exitance * 0.8, float_rounding * exitance)
        << s;
}

TEST(ParallelLight, CastsTheShadowOfABox) {
  SceneBuilder builder;
  const int grey = builder.material({"grey", 0.4, 0, 0});
  builder.object("ground").quad({-6, -6, 0}, {6, -6, 0}, {6, 6, 0}, {-6, 6, 0}, grey);
  builder.object("box").box({-0.3, -0.4, 1}, {1, 0.9, 2}, grey, Facing::outward);
  Scene scene = builder.scene();
  add_lamp_above(scene);
  const auto solved = solve(scene, {night}, lamp_rules(0), {.max_edge_m = 1});
  const double shadow = 1.3 * 1.3;
  const auto power = [&](bool on_ground) {
    std::vector<double> values =
        solved.means([&](std::size_t i) { return (solved.patches[i].triangle < 2) == on_ground; });
    double area = 0;
    for (std::size_t i = 0; i < solved.area.size(); ++i)
      if ((solved.patches[i].triangle < 2) == on_ground) area += solved.area[i];
    for (auto& v : values) v *= area;
    return values;
  };
  for (const auto& [values, truth] :
       {std::pair{power(true), exitance * (16 - shadow)}, {power(false), exitance * shadow}}) {
    const Verdict verdict = expect_mean(values, truth, float_rounding * truth);
    EXPECT_TRUE(verdict) << verdict.text;
    EXPECT_FALSE(expect_mean(values, truth * 1.02, float_rounding * truth));
  }
}

TEST(ParallelLight, OfSeveralDirectionsAddsUp) {
  SceneBuilder builder;
  builder.object("plate").quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0},
                               builder.material({"black", 0, 0, 0}));
  Scene scene = builder.scene();
  add_lamp_above(scene);
  add_parallel_source(scene, {-3, -3, 3}, {0, 6, 0}, {6, 0, 0}, 100);
  // Along (0.6, 0, -0.8).
  add_parallel_source(scene, {-6, -2, 2}, {0, 4, 0}, {6.4, 0, 4.8}, 50);
  add_parallel_source(scene, {-3, -3, 4}, {6, 0, 0}, {0, 6, 0}, 1000);  // shines up
  const auto solved = solve(scene, {night}, lamp_rules(0), {.max_edge_m = 0.5});
  for (std::size_t i = 0; i < solved.area.size(); ++i)
    ASSERT_NEAR(static_cast<double>(solved.tally.irradiance[lamps][i]), exitance + 100 + 50 * 0.8,
                float_rounding * 1000);
}

/// A mirror at 45° turns the beam from above onto a wall.
struct Turned {
  Scene scene;
  explicit Turned(double mirror) {
    SceneBuilder builder;
    const int grey = builder.material({"grey", 0.5, 0, 0});
    builder.object("mirror").quad({-1, -1, 0}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 0},
                                  builder.material({"mirror", 0.1, mirror, 0}));
    builder.object("wall").quad({-5, -3, -2}, {-5, 3, -2}, {-5, 3, 4}, {-5, -3, 4}, grey);
    builder.object("ground").quad({-8, -8, -3}, {8, -8, -3}, {8, 8, -3}, {-8, 8, -3}, grey);
    scene = builder.scene();
    add_lamp_above(scene);
  }
};

TEST(ParallelLight, IsTurnedByMirrors) {
  const double mirror = 0.7;
  const Turned turned(mirror);
  const auto solved = solve(turned.scene, {night}, lamp_rules(0), {.max_edge_m = 1});
  auto wall = solved.means([&](std::size_t i) {
    return solved.patches[i].triangle == 2 || solved.patches[i].triangle == 3;
  });
  for (auto& E : wall) E *= 36;
  const double truth = exitance * mirror * 4;  // the mirror's shadow is 2 m × 2 m
  const Verdict verdict = expect_mean(wall, truth, float_rounding * truth);
  EXPECT_TRUE(verdict) << verdict.text;
  EXPECT_FALSE(expect_mean(wall, truth * 1.02, float_rounding * truth));
}

TEST(ParallelLight, ClosesTheLedger) {
  const Turned turned(0.7);
  SolverRules rules = lamp_rules(30);
  rules.errors = Errors::instants;
  const auto solved = solve(turned.scene, {night, night}, rules, {.max_edge_m = 1});
  const double emitted = exitance * 16;  // all of the beam meets mirror or ground
  const auto in = solved.ledger([](const Ledger& l) { return l[Term::emitted]; });
  EXPECT_TRUE(expect_mean(in, 2 * emitted, float_rounding * emitted));
  const auto residual = solved.ledger([](const Ledger& l) { return l.residual(); });
  const Verdict verdict = expect_mean(residual, 0, float_rounding * emitted);
  EXPECT_TRUE(verdict) << verdict.text;
  EXPECT_LE(verdict.standard_error, 0.01 * emitted);
  // Planted: what mirrors sent out is forgotten, or counted as emitted.
  const auto faulty = solved.ledger([&](const Ledger& l) { return l.residual() + 0.2 * l.in(); });
  EXPECT_FALSE(expect_mean(faulty, 0, float_rounding * emitted));
  for (const auto& ledger : solved.tally.ledger)
    EXPECT_LE(std::abs(ledger.residual()),
              accepted_t(16) * verdict.standard_error + float_rounding * emitted);
  for (std::size_t r = 0; r < 16; ++r) {
    const double sum =
        solved.tally.ledger_instants[r][0].in() + solved.tally.ledger_instants[r][1].in();
    EXPECT_NEAR(sum, solved.tally.ledger_realization[r].in(), float_rounding * emitted);
  }
}

}  // namespace
}  // namespace sunload::test
