// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Energy: every term of the ledger on its own, and their balance.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/court.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

using Facing = SceneBuilder::Facing;

TEST(Ledger, ResidualIsZeroWithinItsError) {
  const auto solved = solve(court(), three_suns(), test_rules(), {.max_edge_m = 1.5});
  const auto residual = solved.ledger([](const Ledger& l) { return l.residual(); });
  const auto in = solved.ledger([](const Ledger& l) { return l.in(); });
  const double power = mean_error(in).mean;
  const Verdict verdict = expect_mean(residual, 0, float_rounding * power);
  EXPECT_TRUE(verdict) << verdict.text;
  EXPECT_LE(verdict.standard_error, 0.01 * power);

  // Planted fault: what escapes is counted without the patch's reflectance.
  const auto faulty = solved.ledger(
      [](const Ledger& l) { return l.residual() + l[Term::escaped] - l[Term::escaped] / 0.3; });
  EXPECT_FALSE(expect_mean(faulty, 0, float_rounding * power));
}

TEST(Ledger, ClosesForEverySunOfThePooledLines) {
  const auto solved = solve(court(), three_suns(), test_rules(), {.max_edge_m = 1.5});
  const auto residual = solved.ledger([](const Ledger& l) { return l.residual(); });
  const double sd_of_sum = mean_error(residual).standard_error;
  for (const auto& ledger : solved.tally.ledger) {
    // One sun of three: its error is at most that of the sum of all of them,
    // as their errors come from the same lines.
    EXPECT_LE(std::abs(ledger.residual()),
              accepted_t(residual.size()) * sd_of_sum + float_rounding * ledger.in());
    EXPECT_GT(ledger[Term::sun], 0);
    EXPECT_GT(ledger[Term::sky], 0);
    EXPECT_GT(ledger[Term::ground], 0);
    EXPECT_NEAR(ledger[Term::emitted], 25, 1e-4);
    EXPECT_GT(ledger[Term::escaped], 0);
    EXPECT_GT(ledger[Term::absorbed], 0);
  }
}

// After many bounces what is left is below any rounding, and still light.
TEST(Ledger, WhatIsNotFollowedIsNeverBelowZero) {
  SolverRules rules = test_rules();
  rules.realizations = 2;
  rules.lines_per_patch = 64;
  rules.mirror_depth = 100;
  for (const Unfollowed unfollowed : {Unfollowed::leave, Unfollowed::estimate})
    for (const int bounces : {0, 1, 2, 60}) {
      rules.unfollowed = unfollowed;
      rules.bounces = bounces;
      const auto solved = solve(court(), three_suns(), rules, {.max_edge_m = 1.5});
      for (const auto& ledgers : {solved.tally.ledger, solved.tally.ledger_realization})
        for (const Ledger& ledger : ledgers) {
          EXPECT_GE(ledger[Term::unshot], 0) << bounces;
          EXPECT_EQ(ledger[Term::unshot] > 1e-3 * ledger.in(), bounces < 3) << bounces;
        }
    }
}

// Shares in single precision add up to a little more than 1 here.
TEST(Ledger, WhatAbsorbsNothingTakesNoPower) {
  SceneBuilder builder;
  builder.box({0, 0, 0}, {2, 3, 4}, builder.material({"m", 0.2, 0.8, 0}), Facing::outward);
  const auto solved = solve(builder.scene(), three_suns(), test_rules(), {.max_edge_m = 1});
  for (const auto& ledgers : {solved.tally.ledger, solved.tally.ledger_realization})
    for (const Ledger& ledger : ledgers) {
      EXPECT_GE(ledger[Term::absorbed], 0);
      EXPECT_GT(ledger.in(), 0);
    }
}

// Parallel light that a closed body intercepts is DNI times its silhouette.
TEST(Ledger, DirectPowerIsDniTimesSilhouette) {
  SceneBuilder builder;
  builder.box({0, 0, 0}, {2, 3, 4}, builder.material({"m", 0.4, 0, 0}), Facing::outward);
  builder.object("second").box({3, 0, 0}, {4, 1, 1}, builder.material({"n", 0.2, 0, 0}),
                               Facing::outward);
  const Vec3 w = normalized({0.6, 0.5, 0.62});
  const auto solved =
      solve(builder.scene(), {one_second(w, 900)}, test_rules(), {.max_edge_m = 0.5});
  // The small box stands partly in the shadow of the large one: the union of two
  // hexagons, from a fine raster of the plane across w.
  const Tangents axes = tangents(w);
  const auto meets = [&](Vec3 origin, Vec3 low, Vec3 high) {
    double near = -1e9, far = 1e9;
    for (const auto& [o, d, l, h] : {std::array{origin.x, w.x, low.x, high.x},
                                     {origin.y, w.y, low.y, high.y},
                                     {origin.z, w.z, low.z, high.z}}) {
      near = std::max(near, std::min((l - o) / d, (h - o) / d));
      far = std::min(far, std::max((l - o) / d, (h - o) / d));
    }
    return near < far;
  };
  constexpr int cells = 2000;
  constexpr double half = 6;
  int covered = 0;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      const Vec3 p = Vec3{2, 1.5, 2} + axes.tangent * (half * (2 * (i + 0.5) / cells - 1)) +
                     axes.bitangent * (half * (2 * (j + 0.5) / cells - 1));
      covered += meets(p, {0, 0, 0}, {2, 3, 4}) || meets(p, {3, 0, 0}, {4, 1, 1});
    }
  const double cell = 4 * half * half / (double{cells} * cells);
  const double silhouette = covered * cell;
  // A raster cell is decided wrongly only along the outline, of some 30 m.
  const double raster_error = 30 * std::sqrt(cell) * 900 / std::sqrt(30 / std::sqrt(cell));
  const auto direct = solved.ledger([](const Ledger& l) { return l[Term::sun]; });
  const Verdict verdict = expect_mean(direct, 900 * silhouette, raster_error);
  EXPECT_TRUE(verdict) << verdict.text;
  EXPECT_FALSE(expect_mean(direct, 900 * silhouette * 1.02, raster_error));
}

}  // namespace
}  // namespace sunload::test
