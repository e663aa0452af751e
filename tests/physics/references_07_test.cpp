// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Glass of reference 07 in the light of the sun: what a pane transmits, reflects and keeps.

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "geo/base/units.h"
#include "solver/surface/clear_glass.h"
#include "tests/support/reference.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

constexpr double demanded_sky_error = 0.005;  // of the truth, as a standard error

/// Shares of the sun's power per realization: a pane of 1 m² alone, the sun at that angle.
std::vector<double> share(const Solved& solved, Term term) {
  return solved.ledger([&](const Ledger& l) { return l[term] / l[Term::sun]; });
}

/// A pane of 1 m², and the sun at that angle from its normal.
Solved pane_in_the_sun(const Material& glass, double angle) {
  SceneBuilder builder;
  builder.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, builder.material(glass));
  return solve(builder.scene(), {one_second({std::sin(angle), 0, std::cos(angle)}, 800)},
               test_rules());
}

TEST(Glass, TransmitsReflectsAndKeepsTheReferencesShares) {
  const auto cases = reference_cases("07_cie171_bestest/cie171_style.json", "glass_fresnel");
  ASSERT_GE(cases.size(), 3u);
  for (const auto& c : cases) {
    const double angle = radians(number(c["angle_deg"]));
    Material glass{"pane"};
    Panes panes{.refractive_index = 1.526};
    panes.absorption_per_m = number(c["KL"]) / panes.thickness_m;
    glass.smooth = panes;
    // Planted fault: the sun 15° lower.
    const Solved solved = pane_in_the_sun(glass, angle),
                 lower = pane_in_the_sun(glass, angle + radians(15));
    for (const auto& [name, term] :
         {std::pair{"T", Term::transmitted}, {"R", Term::escaped}, {"A", Term::absorbed}}) {
      const double truth = number(c[name]);
      const auto values = share(solved, term);
      const std::string id = c["id"].get<std::string>() + " " + name;
      const Verdict verdict = expect_mean(values, truth, float_rounding);
      std::cout << id << ": " << verdict.text << "\n";
      EXPECT_TRUE(verdict) << id << ": " << verdict.text;
      EXPECT_LE(verdict.standard_error, demanded_sky_error * truth + 1e-15) << id;
      if (truth > float_rounding) {
        EXPECT_FALSE(expect_mean(share(lower, term), truth, float_rounding))
            << id << ": planted fault unnoticed";
      }
    }
  }
}

TEST(Glass, KnownByItsNormalTransmittanceTransmitsTheReferencesShare) {
  const auto cases = reference_cases("07_cie171_bestest/cie171_style.json", "glass_rivero");
  ASSERT_EQ(cases.size(), 4u);
  for (const auto& c : cases) {
    const auto id = c["id"].get<std::string>();
    const double angle = radians(number(c["angle_deg"])), T = number(c["T"]);
    Material glass{"pane", 0.03, 0.05};
    glass.smooth = ClearGlass{number(c["T0"])};
    const Solved solved = pane_in_the_sun(glass, angle);
    const auto transmitted = share(solved, Term::transmitted);
    const Verdict verdict = expect_mean(transmitted, T, float_rounding);
    std::cout << id << ": " << verdict.text << "\n";
    EXPECT_TRUE(verdict) << id << ": " << verdict.text;
    EXPECT_LE(verdict.standard_error, demanded_sky_error * T) << id;
    // Nothing stands around: both reflected parts leave. The rest is kept.
    EXPECT_TRUE(expect_mean(share(solved, Term::escaped), 0.08, float_rounding)) << id;
    EXPECT_TRUE(expect_mean(share(solved, Term::absorbed), 0.92 - T, float_rounding)) << id;
    // Planted faults: the sun 15° lower, no factor, the square of the sine.
    EXPECT_FALSE(expect_mean(share(pane_in_the_sun(glass, angle + radians(15)), Term::transmitted),
                             T, float_rounding))
        << id;
    EXPECT_FALSE(expect_mean(transmitted, T / clear_glass_factor, float_rounding)) << id;
    if (const double s = std::sin(angle); s > 0) {
      EXPECT_FALSE(expect_mean(transmitted, T * (1 + s * s) / (1 + s * s * s), float_rounding))
          << id;
    }
  }
}

}  // namespace
}  // namespace sunload::test
