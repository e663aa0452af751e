// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Clear glass known by its normal transmittance, in all kinds of light and by both transports.

#include "solver/surface/clear_glass.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "geo/base/units.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

/// The ledger of shooting closes to this share of what comes in (docs/developer/design.md, Result
/// and ledger).
constexpr double glass_closes = 1e-6;

constexpr double T0 = 0.85, diffuse = 0.02, mirror = 0.1;

Material clear_glass(double mirrored = mirror) {
  Material m{"clear glass", diffuse, mirrored};
  m.smooth = ClearGlass{T0};
  return m;
}

SolverRules glass_rules(Transport transport) {
  SolverRules rules = test_rules();
  rules.transport = transport;
  return rules;
}

constexpr Transport both[] = {Transport::gather, Transport::shoot};

Vec3 sun_at(double zenith_deg) {
  const double zenith = zenith_deg * radians_per_degree;
  return {std::sin(zenith), 0, std::cos(zenith)};
}

/// A horizontal pane of 4 m².
Scene plate(const Material& material) {
  SceneBuilder builder;
  builder.quad({0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, builder.material(material));
  return builder.scene();
}

TEST(ClearGlass, DividesTheSunAtItsAngle) {
  for (const auto transport : both)
    for (const double rho_s : {0.0, mirror})
      for (const double zenith : {0.0, 30.0, 50.0, 80.0}) {
        const Vec3 sun = sun_at(zenith);
        const auto solved =
            solve(plate(clear_glass(rho_s)), {one_second(sun, 800)}, glass_rules(transport));
        const double power = 4 * 800 * sun.z, T = clear_glass_transmittance(T0, sun.z);
        const Ledger& ledger = solved.tally.ledger[0];
        EXPECT_NEAR(ledger[Term::transmitted], T * power, float_rounding * power) << zenith;
        EXPECT_NEAR(ledger[Term::escaped], (diffuse + rho_s) * power, float_rounding * power);
        EXPECT_NEAR(ledger[Term::absorbed], (1 - diffuse - rho_s - T) * power,
                    float_rounding * power);
        EXPECT_NEAR(ledger.residual(), 0, float_rounding * power);
        EXPECT_NEAR(static_cast<double>(solved.tally.irradiance[0][0]), power / 4,
                    float_rounding * power);
      }
}

TEST(ClearGlass, TransmitsTheSkyAtEveryAngle) {
  const double truth = 400 * 1.018 * T0 * (2.0 / 3 + pi / 16);
  for (const auto transport : both) {
    const auto solved =
        solve(plate(clear_glass()), {with_uniform_sky(one_second({0, 0, -1}, 0), 100)},
              glass_rules(transport));
    const auto transmitted = solved.ledger([](const Ledger& l) { return l[Term::transmitted]; });
    const Verdict verdict = expect_mean(transmitted, truth);
    EXPECT_TRUE(verdict) << verdict.text;
    // Planted faults: the normal's transmittance at every angle, the formula without its factor.
    EXPECT_FALSE(expect_mean(transmitted, 400 * T0));
    EXPECT_FALSE(expect_mean(transmitted, truth / clear_glass_factor));
    EXPECT_TRUE(expect_mean(solved.ledger([](const Ledger& l) { return l.residual(); }), 0, 4e-3));
  }
}

/// The sun on a facade of clear glass, 2 m × 2 m, reaches the black ground before it with the share
/// that is given. The facade's light lands on 2 m × 2.4 m.
Scene facade(double rho_s, double ground_from, double ground_to) {
  SceneBuilder builder;
  builder.object("ground").quad({ground_from, -1, 0}, {ground_to, -1, 0}, {ground_to, 1, 0},
                                {ground_from, 1, 0}, builder.material({"black"}));
  builder.object("facade").quad({0, -1, 0}, {0, 1, 0}, {0, 1, 2}, {0, -1, 2},
                                builder.material(clear_glass(rho_s)));
  return builder.scene();
}

/// Mirrored power on the ground.
double mirrored_w(const Solved& solved) {
  const auto part = static_cast<std::size_t>(Part::mirror);
  double power = 0;
  for (std::size_t i = 0; i < solved.area.size(); ++i)
    if (solved.patches[i].triangle < 2)
      power += solved.area[i] * static_cast<double>(solved.tally.irradiance[part][i]);
  return power;
}

TEST(ClearGlass, ReflectsWhatItIsGiven) {
  const Vec3 sun = sun_at(50);
  for (const double rho_s : {0.0, mirror}) {
    // Images of the sun: every point of the ground near the facade sees one. All of it is shot
    // onto a ground that is large enough.
    const auto gathered =
        solve(facade(rho_s, 0.2, 1), {one_second(sun, 700)}, glass_rules(Transport::gather));
    EXPECT_NEAR(mirrored_w(gathered), 700 * sun.z * rho_s * 2 * 0.8, 700 * float_rounding);
    const auto shot =
        solve(facade(rho_s, 0, 3), {one_second(sun, 700)}, glass_rules(Transport::shoot));
    EXPECT_NEAR(mirrored_w(shot), 700 * sun.x * rho_s * 4, 700 * 4 * float_rounding);
  }
}

/// A mirror at 45° turns light from the zenith towards -x, onto a pane that hangs over: its front
/// sees the mirror under 30°, and no sun. The mirror is 2 m × 2 m as seen from above.
Scene turned() {
  SceneBuilder builder;
  const double c = std::cos(radians(30)), s = std::sin(radians(30));
  const Vec3 at{-6, 0, 1}, up{s, 0, c}, side{0, 1, 0};
  builder.object("mirror").quad({-1, -1, 0}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 0},
                                builder.material({"mirror", 0, 0.7}));
  builder.object("pane").quad(at - 2 * up - 2 * side, at - 2 * up + 2 * side,
                              at + 2 * up + 2 * side, at + 2 * up - 2 * side,
                              builder.material(clear_glass()));
  return builder.scene();
}

TEST(ClearGlass, DividesMirroredSunAtItsAngle) {
  for (const auto transport : both) {
    SolverRules rules = glass_rules(transport);
    rules.bounces = 0;
    const auto solved = solve(turned(), {one_second({0, 0, 1}, 900)}, rules);
    const double sent = 900 * 4 * 0.7, T = clear_glass_transmittance(T0, std::cos(radians(30)));
    for (const auto& ledger : solved.tally.ledger) {
      EXPECT_NEAR(ledger[Term::sun], 900 * 4, float_rounding * sent);
      EXPECT_NEAR(ledger[Term::transmitted], T * sent, float_rounding * sent);
      // Planted fault: as if from the normal.
      EXPECT_GT(std::abs(ledger[Term::transmitted] - clear_glass_transmittance(T0, 1) * sent),
                100 * float_rounding * sent);
    }
    EXPECT_TRUE(expect_mean(solved.ledger([](const Ledger& l) { return l.residual(); }), 0,
                            float_rounding * sent));
  }
}

TEST(ClearGlass, DividesParallelLightAtItsAngle) {
  Scene scene = plate(clear_glass());
  // Along (0.6, 0, -0.8), wider than the plate.
  add_parallel_source(scene, {-6, -2, 2}, {0, 6, 0}, {9.6, 0, 7.2}, 50);
  const auto solved = solve(scene, {night}, glass_rules(Transport::gather));
  const double power = 50 * 0.8 * 4, T = clear_glass_transmittance(T0, 0.8);
  for (const auto& ledger : solved.tally.ledger) {
    EXPECT_NEAR(ledger[Term::emitted], power, float_rounding * power);
    EXPECT_NEAR(ledger[Term::transmitted], T * power, float_rounding * power);
    EXPECT_NEAR(ledger[Term::absorbed], (1 - diffuse - mirror - T) * power, float_rounding * power);
  }
}

/// A court of clear glass with a lamp, a crown and a mirror: all light that there is.
Scene court_of_clear_glass() {
  SceneBuilder builder;
  Material crown{"crown", 0.15, 0.1};
  crown.transmittance = 0.4;
  const int ground = builder.material({"ground", 0.3}), window = builder.material(clear_glass()),
            dark = builder.material(clear_glass(0)), lamp = builder.material({"lamp", 0.3, 0, 25}),
            leaves = builder.material(crown), steel = builder.material({"steel", 0.1, 0.7});
  builder.object("ground").quad({-8, -8, 0}, {8, -8, 0}, {8, 8, 0}, {-8, 8, 0}, ground);
  builder.object("north").quad({-6, 4, 0.1}, {6, 4, 0.1}, {6, 4, 6}, {-6, 4, 6}, window);
  builder.object("east").quad({6, 4, 0.1}, {6, -4, 0.1}, {6, -4, 6}, {6, 4, 6}, dark);
  builder.object("west").quad({-6, -4, 0.1}, {-6, 4, 0.1}, {-6, 4, 6}, {-6, -4, 6}, steel);
  builder.object("lamp").quad({3, -1, 3}, {3, 0, 3}, {4, 0, 3}, {4, -1, 3}, lamp);
  builder.sides(Sides::two);
  builder.object("crown").quad({-2, -2, 1}, {0, -2, 1}, {0, -2, 4}, {-2, -2, 4}, leaves);
  builder.object("fence").quad({1, -3, 0.1}, {4, -3, 0.1}, {4, -3, 2}, {1, -3, 2}, window);
  return builder.scene();
}

const SplitRules court_mesh{.max_edge_m = 4};

TEST(ClearGlass, LedgerOfACourtCloses) {
  for (const auto transport : both)
    for (const int depth : {0, 4}) {
      SolverRules rules = glass_rules(transport);
      rules.bounces = 20;
      rules.mirror_depth = depth;
      const auto solved = solve(court_of_clear_glass(), three_suns(), rules, court_mesh);
      const double in = mean_error(solved.ledger([](const Ledger& l) { return l.in(); })).mean;
      const auto residual = solved.ledger([](const Ledger& l) { return l.residual(); });
      const Verdict verdict = expect_mean(residual, 0, float_rounding * in);
      EXPECT_TRUE(verdict) << depth << ": " << verdict.text;
      EXPECT_LE(verdict.standard_error, 0.01 * in);
      // Planted faults: what glass transmits is not booked, or is booked a tenth too high.
      for (const double fault : {1.0, -0.1})
        EXPECT_FALSE(expect_mean(solved.ledger([&](const Ledger& l) {
          return l.residual() + fault * l[Term::transmitted];
        }),
                                 0, float_rounding * in));
      if (transport == Transport::gather) continue;
      for (const auto& ledger : solved.tally.ledger)
        EXPECT_LE(std::abs(ledger.residual()), glass_closes * ledger.in()) << depth;
    }
}

/// The transports have no line in common, and agree on where light ends.
TEST(ClearGlass, TransportsAgreeOnWhatPasses) {
  std::vector<double> of[2];
  for (const auto transport : both) {
    SolverRules rules = glass_rules(transport);
    rules.bounces = 20;
    rules.seed = transport == Transport::shoot ? 2 : 1;
    of[transport == Transport::shoot] =
        solve(court_of_clear_glass(), three_suns(), rules, court_mesh).ledger([](const Ledger& l) {
          return l[Term::transmitted];
        });
  }
  ASSERT_EQ(of[0].size(), of[1].size());
  std::vector<double> difference, faulty;
  for (std::size_t r = 0; r < of[0].size(); ++r) {
    difference.push_back(of[0][r] - of[1][r]);
    faulty.push_back(of[0][r] - of[1][r] * 0.9);
  }
  const Verdict verdict = expect_mean(difference, 0, float_rounding * of[0][0]);
  EXPECT_TRUE(verdict) << verdict.text;
  std::cout << "of " << of[0][0] << " W: " << verdict.text << "\n";
  // Planted fault: one books a tenth less.
  EXPECT_FALSE(expect_mean(faulty, 0, float_rounding * of[0][0]));
}

}  // namespace
}  // namespace sunload::test
