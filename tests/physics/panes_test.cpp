// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Panes and metals in the light of sun and sky: what passes, what is reflected, what is kept.

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "solver/surface/fresnel.h"
#include "tests/support/quadrature.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

using Facing = SceneBuilder::Facing;

Material pane(double index = 1.52, int count = 1, double absorption_per_m = 0) {
  Material m{"pane"};
  m.smooth = Panes{.refractive_index = index, .absorption_per_m = absorption_per_m, .count = count};
  return m;
}

constexpr Metal sheet_metal{.refractive_index = 1.44, .extinction_coefficient = 5.23};

Vec3 sun_at_zenith(double zenith_deg) {
  const double zenith = zenith_deg * radians_per_degree;
  return {std::sin(zenith), 0, std::cos(zenith)};
}

/// A horizontal pane of 4 m² alone in the light.
Solved alone(const Material& material, const IntervalLight& light) {
  SceneBuilder builder;
  builder.quad({0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, builder.material(material));
  return solve(builder.scene(), {light}, test_rules());
}

TEST(Pane, TransmitsTheSunAtItsAngle) {
  for (const double zenith : {0.0, 40.0, 75.0}) {
    Material glass = pane(1.526, 2, 12);
    glass.diffuse = 0.1;
    const auto solved = alone(glass, one_second(sun_at_zenith(zenith), 800));
    const double power = 4 * 800 * std::cos(zenith * radians_per_degree);
    const PaneShares shares =
        pane_shares({1.526, 12 * 0.004, 2}, std::cos(zenith * radians_per_degree));
    const Ledger& ledger = solved.tally.ledger[0];
    EXPECT_NEAR(ledger[Term::transmitted], 0.9 * shares.transmitted * power, 1e-5 * power);
    EXPECT_NEAR(ledger[Term::absorbed], 0.9 * (1 - shares.reflected - shares.transmitted) * power,
                1e-5 * power);
    // Nothing stands around: the reflected part and the coat's leave.
    EXPECT_NEAR(ledger[Term::escaped], (0.9 * shares.reflected + 0.1) * power, 1e-5 * power);
    EXPECT_NEAR(ledger.residual(), 0, 1e-5 * power);
    EXPECT_NEAR(solved.tally.irradiance[0][0], power / 4, 1e-5 * power);
  }
}

TEST(Pane, TransmitsTheSkyAtEveryAngle) {
  const Material glass = pane(1.52, 1, 20);
  const auto solved = alone(glass, with_uniform_sky(one_second({0, 0, -1}, 0), 100));
  const double truth = 400 * hemispherical([](double c) {
                         return pane_shares({1.52, 20 * 0.004, 1}, c).transmitted;
                       });
  const auto transmitted = solved.ledger([](const Ledger& l) { return l[Term::transmitted]; });
  const Verdict verdict = expect_mean(transmitted, truth);
  EXPECT_TRUE(verdict) << verdict.text;
  // Planted fault: the transmittance of light from the normal at every angle.
  EXPECT_FALSE(expect_mean(transmitted, 400 * pane_shares({1.52, 0.08, 1}, 1).transmitted));
  EXPECT_TRUE(expect_mean(solved.ledger([](const Ledger& l) { return l.residual(); }), 0, 4e-3));
}

// A facade of glass sends the sun to the ground before it with the reflectance at its angle.
TEST(Pane, ReflectsTheSunToTheGround) {
  for (const bool metal : {false, true})
    for (const double zenith : {20.0, 50.0}) {
      Material glass = pane();
      if (metal) glass.smooth = sheet_metal;
      SceneBuilder builder;
      const int black = builder.material({"black"}), mirror = builder.material(glass);
      builder.object("ground").quad({0.2, -1, 0}, {1, -1, 0}, {1, 1, 0}, {0.2, 1, 0}, black);
      builder.object("facade").quad({0, -50, 0}, {0, 50, 0}, {0, 50, 90}, {0, -50, 90}, mirror);
      const Vec3 sun = sun_at_zenith(zenith);
      const auto solved = solve(builder.scene(), {one_second(sun, 700)}, test_rules());
      const double R =
          metal ? metal_reflectance(1.44, 5.23, sun.x) : pane_shares({1.52, 0, 1}, sun.x).reflected;
      const auto part = static_cast<std::size_t>(Part::mirror);
      EXPECT_NEAR(solved.tally.irradiance[part][0], 700 * sun.z * R, 700 * float_rounding);
    }
}

/// A street whose north side is glazed, with a bay of metal, a lamp, and clear glass that has no
/// index: a screen, and a roof light that reflects nothing.
Scene glazed_street() {
  SceneBuilder builder;
  Material glass = pane(1.52, 2, 15), metal{"metal", 0.2}, frit = pane(1.52, 1, 30);
  metal.smooth = sheet_metal;
  frit.name = "frit";
  frit.diffuse = 0.4;
  Material screen{"screen", 0.05, 0.1}, roof_light{"roof light"};
  screen.smooth = ClearGlass{0.8};
  roof_light.smooth = ClearGlass{0.6};
  const int ground = builder.material({"ground", 0.25}), wall = builder.material({"wall", 0.45}),
            lamp = builder.material({"lamp", 0.3, 0, 25}), window = builder.material(glass),
            sheet = builder.material(metal), printed = builder.material(frit),
            clear = builder.material(screen), skylight = builder.material(roof_light);
  builder.object("ground").quad({-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0}, ground);
  builder.object("house").box({-6, 3, 0.01}, {6, 6, 5}, wall, Facing::outward);
  builder.object("window").quad({-5, 2.99, 0.5}, {0, 2.99, 0.5}, {0, 2.99, 4.5}, {-5, 2.99, 4.5},
                                window);
  builder.object("printed").quad({0, 2.99, 0.5}, {5, 2.99, 0.5}, {5, 2.99, 4.5}, {0, 2.99, 4.5},
                                 printed);
  builder.object("tower").box({-6, -5, 0.01}, {-3, -2, 8}, wall, Facing::outward);
  builder.object("metal").quad({2, -3, 0.2}, {-2, -3, 0.2}, {-2, -3, 4}, {2, -3, 4}, sheet);
  builder.object("lamp").quad({3, -1, 3}, {3, 0, 3}, {4, 0, 3}, {4, -1, 3}, lamp);
  builder.object("skylight").quad({-5, 4, 5.1}, {5, 4, 5.1}, {5, 5, 5.5}, {-5, 5, 5.5}, skylight);
  builder.sides(Sides::two)
      .object("screen")
      .quad({5, -8, 0.2}, {8, -8, 0.2}, {8, -8, 3}, {5, -8, 3}, clear)
      .object("double")
      .quad({8, -8, 0.2}, {9, -8, 0.2}, {9, -8, 3}, {8, -8, 3}, window);
  return builder.scene();
}

TEST(Pane, LedgerOfAGlazedStreetCloses) {
  auto rules = test_rules();
  rules.bounces = 20;
  const auto solved = solve(glazed_street(), three_suns(), rules, {.max_edge_m = 1.5});
  const auto residual = solved.ledger([](const Ledger& l) { return l.residual(); });
  const double in = mean_error(solved.ledger([](const Ledger& l) { return l.in(); })).mean;
  const auto transmitted = solved.ledger([](const Ledger& l) { return l[Term::transmitted]; });
  const Verdict verdict = expect_mean(residual, 0, float_rounding * in);
  std::cout << "in " << in << " W, transmitted " << mean_error(transmitted).mean << " W, residual "
            << verdict.text << "\n";
  EXPECT_TRUE(verdict) << verdict.text;
  EXPECT_LE(verdict.standard_error, 0.01 * in);
  EXPECT_GT(mean_error(transmitted).mean, 0.01 * in);
  // Planted faults: what panes transmit is not booked, or is booked a tenth too high.
  for (const double fault : {1.0, -0.1})
    EXPECT_FALSE(expect_mean(
        solved.ledger([&](const Ledger& l) { return l.residual() + fault * l[Term::transmitted]; }),
        0, float_rounding * in));
  for (const auto& ledger : solved.tally.ledger)
    EXPECT_LE(std::abs(ledger.residual()),
              accepted_t(residual.size()) * verdict.standard_error + float_rounding * ledger.in());
}

// Depth of reflection: what is cut is booked, panes or not.
TEST(Pane, LedgerClosesAtEveryMirrorDepth) {
  auto light = with_uniform_sky(one_second({0.3, -0.6, 0.7}, 600), 100);
  light.ground_exitance = 50;
  for (const int depth : {0, 1, 3}) {
    auto rules = test_rules();
    rules.mirror_depth = depth;
    rules.bounces = 20;
    const auto solved = solve(glazed_street(), {light}, rules, {.max_edge_m = 1.5});
    const double in = mean_error(solved.ledger([](const Ledger& l) { return l.in(); })).mean;
    const Verdict verdict = expect_mean(solved.ledger([](const Ledger& l) { return l.residual(); }),
                                        0, float_rounding * in);
    EXPECT_TRUE(verdict) << depth << ": " << verdict.text;
  }
}

}  // namespace
}  // namespace sunload::test
