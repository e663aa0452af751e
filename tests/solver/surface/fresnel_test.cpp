// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Fresnel's formulas against published cases and against each other.

#include "solver/surface/fresnel.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geo/base/units.h"
#include "solver/surface/material.h"
#include "tests/support/reference.h"

namespace sunload::test {
namespace {

double cosine(double angle_deg) { return std::cos(angle_deg * radians_per_degree); }

TEST(Pane, ReferenceCases) {
  for (const auto& c : reference_cases("07_cie171_bestest/cie171_style.json", "glass_fresnel")) {
    const PaneShares glass =
        pane_shares({1.526, number(c["KL"]), 1}, cosine(number(c["angle_deg"])));
    constexpr double last_digit = 1e-9;
    EXPECT_NEAR(glass.transmitted, number(c["T"]), last_digit) << c["id"];
    EXPECT_NEAR(glass.reflected, number(c["R"]), last_digit) << c["id"];
    EXPECT_NEAR(1 - glass.transmitted - glass.reflected, number(c["A"]), last_digit) << c["id"];
  }
}

// A pane reflects twice what one face does, and a little less: 8.2 %, not 4.3 %.
TEST(Pane, BothFacesReflect) {
  const double r = std::pow(0.52 / 2.52, 2);
  EXPECT_NEAR(pane_shares({1.52, 0, 1}, 1).reflected, 2 * r / (1 + r), 1e-15);
  EXPECT_NEAR(pane_shares({1.52, 0, 1}, 1).reflected, 0.0817, 5e-5);
}

// Without absorption k panes have 2k faces: T = (1 - r) / (1 + (2k - 1) r) for each
// polarisation (Stokes 1862).
TEST(Pane, StackOfClearPanesIsStokes) {
  const double n = 1.6;
  for (const double angle : {0.0, 35.0, 70.0, 89.0})
    for (const int count : {1, 2, 3, 7}) {
      const double c = cosine(angle), t = std::sqrt(1 - (1 - c * c) / (n * n));
      double T = 0;
      for (const double r :
           {std::pow((c - n * t) / (c + n * t), 2), std::pow((t - n * c) / (t + n * c), 2)})
        T += (1 - r) / (1 + (2 * count - 1) * r) / 2;
      const PaneShares glass = pane_shares({n, 0, count}, c);
      EXPECT_NEAR(glass.transmitted, T, 1e-12);
      EXPECT_NEAR(glass.reflected + glass.transmitted, 1, 1e-12);
    }
}

TEST(Pane, AbsorbsWhatIsLeftAndReflectsAllAtGrazing) {
  for (const int count : {1, 2, 5}) {
    double before = 0;
    for (int degree = 0; degree <= 90; ++degree) {
      const PaneShares glass = pane_shares({1.52, 0.05, count}, cosine(degree));
      EXPECT_GE(glass.transmitted, 0);
      EXPECT_LE(glass.reflected + glass.transmitted, 1 + 1e-12);
      if (degree > 60) {
        EXPECT_GT(glass.reflected, before);
      }
      before = glass.reflected;
    }
    EXPECT_EQ(pane_shares({1.52, 0.05, count}, 0).reflected, 1);
    EXPECT_EQ(pane_shares({1.52, 0, count}, 0).transmitted, 0);
    EXPECT_NEAR(pane_shares({1.52, 0, count}, 1e-9).reflected, 1, 1e-6);
  }
}

// One face of glass is a metal without extinction; at Brewster's angle half of its light is gone.
TEST(Metal, WithoutExtinctionIsOneFaceOfGlass) {
  const double n = 1.5;
  for (const double angle : {0.0, 20.0, 56.309932474020215, 80.0}) {
    const double c = cosine(angle), t = std::sqrt(1 - (1 - c * c) / (n * n));
    const double r_s = std::pow((c - n * t) / (c + n * t), 2);
    const double r_p = std::pow((t - n * c) / (t + n * c), 2);
    EXPECT_NEAR(metal_reflectance(n, 0, c), (r_s + r_p) / 2, 1e-12) << angle;
  }
}

TEST(Metal, NormalAndGrazing) {
  // ((n - 1)² + k²) / ((n + 1)² + k²): aluminium at 589 nm, Born & Wolf (1999), table 14.1.
  const double n = 1.44, k = 5.23;
  EXPECT_NEAR(metal_reflectance(n, k, 1), ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k),
              1e-12);
  EXPECT_NEAR(metal_reflectance(n, k, 1), 0.83, 0.005);
  EXPECT_EQ(metal_reflectance(n, k, 0), 1);
  for (int degree = 0; degree <= 90; ++degree) {
    EXPECT_GT(metal_reflectance(n, k, cosine(degree)), 0.7);
    EXPECT_LE(metal_reflectance(n, k, cosine(degree)), 1);
  }
}

TEST(Coat, TakesItsShareAtEveryAngle) {
  Material pane{"pane", 0.3};
  pane.smooth = Panes{.refractive_index = 1.52, .absorption_per_m = 10};
  for (int degree = 0; degree <= 90; ++degree) {
    const SmoothShares shares = smooth_shares(pane, cosine(degree));
    EXPECT_LE(pane.diffuse + shares.mirror + shares.transmitted, 1 + 1e-12);
    EXPECT_NEAR(shares.mirror, 0.7 * pane_shares({1.52, 0.04, 1}, cosine(degree)).reflected, 1e-12);
  }
}

}  // namespace
}  // namespace sunload::test
