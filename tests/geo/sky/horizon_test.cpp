// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The horizon line: interpolation, and what stands above it.
#include "geo/sky/horizon.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geo/base/check.h"

namespace sunload {
namespace {

TEST(Horizon, IsOpenWithoutPoints) {
  const Horizon open;
  EXPECT_TRUE(open.is_open());
  EXPECT_EQ(open.elevation_deg(123), 0);
  EXPECT_TRUE(open.is_above({10, 1e-9}));
  EXPECT_FALSE(open.is_above({10, 0}));
}

TEST(Horizon, IsLinearBetweenPointsAndAcrossNorth) {
  const Horizon horizon({{350, 10}, {20, 4}, {90, 0}});
  EXPECT_EQ(horizon.elevation_deg(350), 10);
  EXPECT_EQ(horizon.elevation_deg(20), 4);
  EXPECT_DOUBLE_EQ(horizon.elevation_deg(5), 7);
  EXPECT_DOUBLE_EQ(horizon.elevation_deg(365), 7);
  EXPECT_DOUBLE_EQ(horizon.elevation_deg(355), 9);
  EXPECT_DOUBLE_EQ(horizon.elevation_deg(-5), 9);
  EXPECT_DOUBLE_EQ(horizon.elevation_deg(220), 5);  // from 90 to 350
  EXPECT_EQ(Horizon({{100, 3}}).elevation_deg(7), 3);
}

TEST(Horizon, TakesAzimuthsAllAround) {
  const Horizon horizon({{-90, 5}, {180, 2}, {-180, 2}, {0, 1}});
  ASSERT_EQ(horizon.points().size(), 3u);
  EXPECT_EQ(horizon.points()[2].azimuth_deg, 270);
  EXPECT_EQ(horizon.elevation_deg(270), 5);
}

TEST(Horizon, RefusesNonsense) {
  EXPECT_THROW(Horizon({{0, -1}}), InputError);
  EXPECT_THROW(Horizon({{0, 90}}), InputError);
  EXPECT_THROW(Horizon({{NAN, 1}}), InputError);
  EXPECT_THROW(Horizon({{180, 1}, {-180, 2}}), InputError);
}

}  // namespace
}  // namespace sunload
