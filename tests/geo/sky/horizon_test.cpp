// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The horizon line: interpolation, and what stands above it.
#include "geo/sky/horizon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geo/base/check.h"
#include "geo/sky/sky.h"

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

/// ∫ share · |n·w| dω [sr] of an upright wall that faces `n`; of the whole sky π/2.
double sky_of_wall(const SkyGrid& grid, const std::vector<double>& shares, Vec3 n) {
  double sum = 0;
  for (int cell = 0; cell < grid.cell_count(); ++cell)
    sum += shares[static_cast<std::size_t>(cell)] * grid.solid_angle() *
           std::max(0.0, dot(grid.direction(cell, 0.5, 0.5), n));
  return sum;
}

TEST(Horizon, LevelLineLeavesWhatItShould) {
  // Above h a wall sees π/2 - h - sin h · cos h, and the whole sky is 2π (1 - sin h). A grid of 64
  // cuts a ring of cells at one height: counted points of a cell gave 0.7 % too much or too little.
  const SkyGrid grid;
  for (const double h_deg : {0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 44.9, 70.0}) {
    const double h = radians(h_deg);
    const auto shares = open_shares(grid, Horizon({{0, h_deg}}), Rotation());
    double sky = 0;
    for (const double share : shares) sky += share * grid.solid_angle();
    // What curves between two places of a cell: (1/128)² / 8 of the square's width in a ring of 2π.
    EXPECT_NEAR(sky, 2 * pi * (1 - std::sin(h)), 2 * pi * 2e-5) << h_deg;
    // Middles of cells stand for them: 1e-4 of the open wall, of a cut ring its width on top.
    for (const Vec3 n : {Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{0.6, 0.8, 0}})
      EXPECT_NEAR(sky_of_wall(grid, shares, n), pi / 2 - h - std::sin(h) * std::cos(h), 6e-4)
          << h_deg;
  }
}

TEST(Horizon, SharesOfPiecesAreThoseOfTheirArea) {
  // A piece of 8° × 8° near the line, which climbs from 2° to 6° over it: against many points.
  const Horizon horizon({{100, 2}, {104, 3}, {108, 6}, {200, 0}});
  const double low = std::sin(radians(0.0)), high = std::sin(radians(8.0));
  const auto place = [&](double u, double v) -> Horizontal {
    return {100 + 8 * u, degrees(std::asin(low + v * (high - low)))};
  };
  constexpr int n = 1000;
  int above = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) above += horizon.is_above(place((i + 0.5) / n, (j + 0.5) / n));
  EXPECT_NEAR(open_share(horizon, place), static_cast<double>(above) / (n * n), 1e-3);
  EXPECT_EQ(open_share(Horizon({{0, 9}}), place), 0);
  EXPECT_EQ(open_share(Horizon({{0, 0}}), place), 1);
}

}  // namespace
}  // namespace sunload
