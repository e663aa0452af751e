// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/base/fast_math.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sunload {
namespace {

constexpr int steps = 1'000'000;

TEST(FastMath, ExponentialKeepsItsAccuracy) {
  double worst = 0;
  for (int i = 0; i <= steps; ++i) {
    const double x = -700 + 1400.0 * i / steps;
    worst = std::max(worst, std::abs(fast_exp(x) / std::exp(x) - 1));
  }
  EXPECT_LT(worst, 2e-14);  // as its header states
  EXPECT_EQ(fast_exp(0), 1);
  EXPECT_EQ(fast_exp(-1e300), fast_exp(-700));
  EXPECT_EQ(fast_exp(1e300), fast_exp(700));
}

TEST(FastMath, SineCosineAndArcsineKeepTheirAccuracy) {
  double worst_sine = 0, worst_cosine = 0, worst_arcsine = 0;
  for (int i = 1; i <= steps; ++i) {
    const double x = static_cast<double>(i) / steps;
    const double angle = std::acos(0.0) * x;
    worst_sine = std::max(worst_sine, std::abs(fast_sin(angle) / std::sin(angle) - 1));
    worst_cosine = std::max(worst_cosine, std::abs(fast_cos(angle / 2) / std::cos(angle / 2) - 1));
    worst_arcsine = std::max(worst_arcsine, std::abs(fast_asin(x) / std::asin(x) - 1));
  }
  EXPECT_LT(worst_sine, 1e-15);
  EXPECT_LT(worst_cosine, 1e-15);
  EXPECT_LT(worst_arcsine, 1e-15);
  EXPECT_EQ(fast_cos(0), 1);
  EXPECT_EQ(fast_asin(0), 0);
  EXPECT_EQ(fast_asin(1), std::asin(1.0));
  EXPECT_EQ(fast_asin(1 + 1e-15), std::asin(1.0));  // a chord rounded above the diameter
}

TEST(FastMath, OctantKeepsItsAccuracy) {
  double worst = 0;
  for (int i = 1; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    worst = std::max(worst, std::abs(fast_octant(t) / (std::atan(t) / std::atan(1.0)) - 1));
  }
  EXPECT_LT(worst, 3e-13);
  EXPECT_EQ(fast_octant(0), 0);
}

}  // namespace
}  // namespace sunload
