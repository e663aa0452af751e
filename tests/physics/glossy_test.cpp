// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Glossy surfaces in the light of sun, sky and other surfaces.

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "tests/support/quadrature.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

using Facing = SceneBuilder::Facing;

Material glossy(double share, double exponent, double diffuse = 0, double mirror = 0) {
  Material m{"glossy", diffuse, mirror};
  m.glossy = share;
  m.glossy_exponent = exponent;
  return m;
}

/// A small black receiver that looks down on a wide glossy plate, 1 m above it.
struct OverPlate {
  explicit OverPlate(const Material& plate) {
    builder.object("receiver")
        .quad({0, 0, 1}, {0, edge, 1}, {edge, edge, 1}, {edge, 0, 1}, builder.material({"black"}));
    builder.object("plate").quad({-half, -half, 0}, {half, -half, 0}, {half, half, 0},
                                 {-half, half, 0}, builder.material(plate));
  }
  Solved solve_with(const IntervalLight& light) const {
    auto rules = test_rules();
    rules.realizations = 32;
    rules.lines_per_patch = 32 * 2048;
    rules.direct_samples = 32;
    return solve(builder.scene(), {light}, rules);
  }
  static std::vector<double> means(const Solved& solved) {
    return solved.means([&](std::size_t i) { return solved.patches[i].triangle < 2; });
  }
  // Seen past the plate: 1/half² of the hemisphere; sky that the receiver hides, to the plate's
  // brightest place below it: its area over π.
  static constexpr double half = 300, edge = 0.02, hidden = 1 / (half * half) + edge * edge;
  SceneBuilder builder;
};

// A plate under a uniform sky sends ρ_g·albedo(θ) of it back: the white furnace, one surface.
TEST(Glossy, PlateUnderAUniformSky) {
  for (const double n : {2.0, 40.0}) {
    const OverPlate scene(glossy(0.8, n));
    const auto solved = scene.solve_with(with_uniform_sky(one_second({0, 0, -1}, 0), 100));
    const double truth =
        80 * integral(0, 1, 60, [&](double c) { return 2 * c * lobe_albedo(c, n); });
    const auto means = OverPlate::means(solved);
    const Verdict verdict = expect_mean(means, truth, 100 * (n + 2) * OverPlate::hidden + 1e-3);
    EXPECT_TRUE(verdict) << n << ": " << verdict.text;
    EXPECT_FALSE(expect_mean(means, 80)) << n;  // the horizon forgotten
  }
}

// All that the plate sends up arrives at the receiver's level: dni·cosθ·ρ_g·albedo(θ).
TEST(Glossy, SunOnAPlate) {
  for (const double n : {1.0, 15.0})
    for (const Vec3 w : {Vec3{0.3, 0.1, 0.9}, Vec3{0.8, 0, 0.5}}) {
      const auto light = one_second(w, 900);
      const Vec3 s = light.direction;
      const OverPlate scene(glossy(0.7, n));
      const auto solved = scene.solve_with(light);
      const double truth = 900 * s.z * 0.7 * lobe_albedo(s.z, n);
      const auto means = OverPlate::means(solved);
      const Verdict verdict = expect_mean(means, truth, truth * (n + 2) * OverPlate::hidden);
      EXPECT_TRUE(verdict) << n << ": " << verdict.text;
      EXPECT_FALSE(expect_mean(means, 1.05 * truth)) << n;
    }
}

// The same of lobes that next to no line meets, with the counts of every day: patches look for
// them. Where the sun is a disk, too.
TEST(Glossy, NarrowLobesHaveLittleNoiseOnPatches) {
  for (const double n : {1000.0, 20000.0})
    for (const double disk : {0.0, 0.0046}) {
      auto light = one_second({0.5, 0.1, 0.8}, 900);
      light.disk_half_angle = disk;
      const OverPlate scene(glossy(0.7, n));
      auto rules = test_rules();
      rules.lines_per_patch = rules.realizations * 16;
      rules.direct_samples = rules.realizations * 2;
      const auto solved = solve(scene.builder.scene(), {light}, rules);
      const double cos_s = light.direction.z;
      const double truth = 900 * cos_s * 0.7 * lobe_albedo(cos_s, n);
      const Verdict verdict = expect_mean(OverPlate::means(solved), truth, 1e-3 * truth);
      EXPECT_TRUE(verdict) << n << ": " << verdict.text;
      EXPECT_LT(verdict.standard_error, 0.02 * truth) << n;
    }
}

// A narrow lobe is all but a mirror: large patches have what plane mirrors of that share send them,
// as the light that passes beside the plate's edge falls on parts of them.
TEST(Glossy, NarrowLobesLightPatchesInPart) {
  std::vector<double> powers[2];
  for (const bool is_lobe : {false, true}) {
    SceneBuilder builder;
    const int black = builder.material({"black"});
    const int plate = builder.material(is_lobe ? glossy(0.7, 1e6) : Material{"mirror", 0, 0.7});
    builder.object("wall").quad({4, 6, 0}, {4, -6, 0}, {4, -6, 8}, {4, 6, 8}, black);
    builder.object("plate").quad({0, -2, 0}, {2, -2, 0}, {2, 2, 0}, {0, 2, 0}, plate);
    auto rules = test_rules();
    rules.direct_samples = rules.realizations * 16;
    const auto solved = solve(builder.scene(), {one_second({-0.6, 0.1, 0.6}, 900)}, rules);
    powers[is_lobe] = solved.means([&](std::size_t i) { return solved.patches[i].triangle < 2; });
  }
  const double mirror = mean_error(powers[0]).mean, error = mean_error(powers[0]).standard_error;
  const Verdict verdict = expect_mean(powers[1], mirror, 4 * error + 0.005 * mirror);
  EXPECT_TRUE(verdict) << verdict.text;
  EXPECT_FALSE(expect_mean(powers[1], 1.3 * mirror, 4 * error)) << verdict.text;
}

/// A court of glossy, mirror and transparent surfaces.
Scene glossy_court() {
  SceneBuilder builder;
  Material pane{"pane"};
  pane.smooth = Panes{.refractive_index = 1.52, .absorption_per_m = 20};
  const int ground = builder.material({"ground", 0.25}), wall = builder.material({"wall", 0.45}),
            mirror = builder.material({"mirror", 0.1, 0.7}),
            lamp = builder.material({"lamp", 0.3, 0, 25}),
            satin = builder.material(glossy(0.5, 20, 0.2)),
            enamel = builder.material(glossy(0.3, 5, 0.1, 0.4)), window = builder.material(pane);
  builder.object("ground").quad({-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0}, ground);
  builder.object("house").box({-6, 3, 0.01}, {6, 6, 5}, wall, Facing::outward);
  builder.object("satin").quad({-5, 2.99, 0.5}, {0, 2.99, 0.5}, {0, 2.99, 4.5}, {-5, 2.99, 4.5},
                               satin);
  builder.object("mirror").quad({0, 2.99, 0.5}, {5, 2.99, 0.5}, {5, 2.99, 4.5}, {0, 2.99, 4.5},
                                mirror);
  builder.object("enamel").quad({2, -3, 0.2}, {-2, -3, 0.2}, {-2, -3, 4}, {2, -3, 4}, enamel);
  builder.object("window").quad({6, -3, 0.2}, {3, -3, 0.2}, {3, -3, 4}, {6, -3, 4}, window);
  builder.object("lamp").quad({3, -1, 3}, {3, 0, 3}, {4, 0, 3}, {4, -1, 3}, lamp);
  return builder.scene();
}

TEST(Glossy, LedgerOfACourtCloses) {
  auto light = with_uniform_sky(one_second({0.3, -0.6, 0.7}, 600), 100);
  light.ground_exitance = 50;
  for (const int depth : {0, 1, 6}) {
    auto rules = test_rules();
    rules.mirror_depth = depth;
    rules.bounces = 20;
    const auto solved = solve(glossy_court(), {light}, rules, {.max_edge_m = 1.5});
    const double in = mean_error(solved.ledger([](const Ledger& l) { return l.in(); })).mean;
    const auto residual = solved.ledger([](const Ledger& l) { return l.residual(); });
    const Verdict verdict = expect_mean(residual, 0, float_rounding * in);
    std::cout << "depth " << depth << ": in " << in << " W, unshot "
              << mean_error(solved.ledger([](const Ledger& l) { return l[Term::unshot]; })).mean
              << " W, residual " << verdict.text << "\n";
    EXPECT_TRUE(verdict) << depth << ": " << verdict.text;
    EXPECT_LE(verdict.standard_error, 0.01 * in);
    // Planted fault: 3 % of what is absorbed is forgotten.
    EXPECT_FALSE(expect_mean(
        solved.ledger([](const Ledger& l) { return l.residual() + 0.03 * l[Term::absorbed]; }), 0,
        float_rounding * in));
  }
}

// Closed furnace: walls that emit M and reflect in part glossily, absorbing what is left. With
// one material everywhere the radiance is the same from all sides only where the lobe's albedo
// is that of the diffuse share; what must hold is the balance: absorbed = emitted.
TEST(Glossy, ClosedRoomAbsorbsWhatItEmits) {
  SceneBuilder builder;
  Material wall = glossy(0.3, 10, 0.3);
  wall.emission_w_m2 = 10;
  builder.box({0, 0, 0}, {3, 4, 2.5}, builder.material(wall), Facing::inward);
  auto rules = test_rules();
  rules.bounces = 60;
  rules.mirror_depth = 60;
  const auto solved = solve(builder.scene(), {one_second({0, 0, -1}, 0)}, rules, {.max_edge_m = 1});
  const double emitted = 10 * 2 * (12 + 7.5 + 10);
  const auto absorbed = solved.ledger([](const Ledger& l) { return l[Term::absorbed]; });
  const Verdict verdict = expect_mean(absorbed, emitted);
  EXPECT_TRUE(verdict) << verdict.text;
  EXPECT_FALSE(expect_mean(absorbed, 1.02 * emitted));
}

}  // namespace
}  // namespace sunload::test
