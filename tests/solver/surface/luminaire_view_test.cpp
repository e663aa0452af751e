// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Which photometries have lobes that directions are drawn by.
#include "solver/surface/luminaire_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "geo/base/units.h"

namespace sunload::test {
namespace {

/// The same in all planes, every 5 degrees.
IntensityWeb round_web(const std::function<double(double)>& intensity_at) {
  IntensityWeb web;
  web.planes_deg = {0};
  for (int gamma = 0; gamma <= 90; gamma += 5) {
    web.gammas_deg.push_back(gamma);
    web.intensities.push_back(intensity_at(gamma));
  }
  return web;
}

TEST(IntensitySteps, WhatIsBrightBeyondSixtyDegreesIsNoLobe) {
  const IntensityWeb cosine = round_web([](double gamma) { return std::cos(radians(gamma)); });
  EXPECT_TRUE(steps_of(cosine).cones.empty());
  EXPECT_EQ(steps_of(cosine).beyond, 1);
  // 0.4 of the largest at 60 degrees.
  const IntensityWeb wide = round_web([](double gamma) { return 1 - gamma / 100; });
  EXPECT_TRUE(steps_of(wide).cones.empty());
}

TEST(IntensitySteps, LobesEndWhereTheyHaveFallenToAQuarter) {
  const IntensityWeb beam = round_web([](double gamma) { return std::exp(-gamma * gamma / 200); });
  const IntensitySteps steps = steps_of(beam);
  ASSERT_FALSE(steps.cones.empty());
  // exp(-γ² / 200) is 1/4 at 16.7 degrees, in the cell from 15 to 20.
  EXPECT_NEAR(degrees(steps.cones.front().angle), 20, 1e-6);
  EXPECT_NEAR(steps.cones.front().intensity, 0.75, 1e-12);
  EXPECT_LT(steps.beyond, 1e-3);
}

}  // namespace
}  // namespace sunload::test
