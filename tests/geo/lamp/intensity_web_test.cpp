// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/lamp/intensity_web.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geo/base/units.h"

namespace sunload {
namespace {

TEST(IntensityWeb, FluxOfEvenLightIsItsSolidAngle) {
  const auto even = [](double half) { return IntensityWeb{{0}, {0, half}, {3, 3}}.flux(); };
  EXPECT_NEAR(even(180), 3 * 4 * pi, 1e-12);
  EXPECT_NEAR(even(30), 3 * 2 * pi * (1 - std::cos(pi / 6)), 1e-12);
}

// I = cos γ (CIE 121: a diffuse luminaire) sends π; linear between degrees it is short by 1/12 of
// the square of a step in radians.
TEST(IntensityWeb, FluxOfADiffuseLuminaireIsPi) {
  IntensityWeb web{{0}, {}, {}};
  for (int g = 0; g <= 90; ++g) {
    web.gammas_deg.push_back(g);
    web.intensities.push_back(std::cos(g * radians_per_degree));
  }
  const double step = radians_per_degree;
  EXPECT_NEAR(web.flux(), pi, pi * step * step / 6);
  EXPECT_LT(web.flux(), pi);
}

TEST(IntensityWeb, IsLinearBetweenPlanesAndAngles) {
  const IntensityWeb web{{0, 90, 360}, {10, 20}, {1, 2, 5, 8, 1, 2}};
  EXPECT_DOUBLE_EQ(web.at(0, 10), 1);
  EXPECT_DOUBLE_EQ(web.at(0, 15), 1.5);
  EXPECT_DOUBLE_EQ(web.at(45, 15), (1.5 + 6.5) / 2);
  EXPECT_DOUBLE_EQ(web.at(225, 20), (8 + 2) / 2.0);
  EXPECT_DOUBLE_EQ(web.at(360, 20), 2);
  EXPECT_EQ(web.at(0, 9.99), 0);  // nothing beyond
  EXPECT_EQ(web.at(0, 20.01), 0);
  EXPECT_DOUBLE_EQ(web.largest(), 8);
}

TEST(IntensityWeb, WhatIsNoneIsABug) {
  for (const IntensityWeb& web :
       {IntensityWeb{{}, {0, 90}, {}}, IntensityWeb{{0, 90}, {0, 90}, {1, 1, 1, 1}},
        IntensityWeb{{0}, {90, 0}, {1, 1}}, IntensityWeb{{0}, {0, 90}, {1}},
        IntensityWeb{{0}, {0, 190}, {1, 1}}, IntensityWeb{{0}, {0, 90}, {1, -1}}})
    EXPECT_THROW(expect_valid(web), std::logic_error);
  EXPECT_NO_THROW(expect_valid({{0, 180, 360}, {0, 90}, {1, 1, 2, 2, 1, 1}}));
}

}  // namespace
}  // namespace sunload
