// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Hills of known height and distance on a plain.
#include "io/scene/raster/land_horizon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "io/weather/horizon_csv.h"
#include "tests/support/refusal_of.h"
#include "tests/support/work_folder.h"

namespace sunload {
namespace {

using test::refusal_of;

constexpr double plain_m = 100;

/// A plain of that many cells on each side of the origin, and a plateau from `ridge_m` eastwards.
Raster plain_with_ridge(int cells, double cell_m, double ridge_m, double height_m) {
  Raster raster;
  raster.columns = raster.rows = static_cast<std::size_t>(2 * cells + 1);
  const double corner = (cells + 0.5) * cell_m;
  raster.file_from_cell = {-corner, cell_m, 0, corner, 0, -cell_m};
  for (std::size_t row = 0; row < raster.rows; ++row)
    for (std::size_t column = 0; column < raster.columns; ++column) {
      const double east = (static_cast<double>(column) - cells) * cell_m;
      raster.values.push_back(plain_m + (east >= ridge_m ? height_m : 0));
    }
  return raster;
}

/// Rises above the eye by the height less what curvature and refraction take.
double elevation_deg(double height_m, double distance_m) {
  const double fall = 0.87 * distance_m * distance_m / (2 * 6371e3);
  return std::atan2(height_m - fall, distance_m) * 180 / std::acos(-1.0);
}

TEST(LandHorizon, IsThatOfARidge) {
  const Raster raster = plain_with_ridge(200, 50, 5000, 500);
  const LandHorizon found = land_horizon("dem", raster, 1, {.place = {0, 0, 0}, .step_deg = 30});
  ASSERT_EQ(found.points.size(), 12u);
  EXPECT_EQ(found.land_m, plain_m);
  for (const std::size_t k : {2u, 3u, 4u}) {
    const double azimuth_deg = 30.0 * static_cast<double>(k);
    const double distance = 5000 / std::sin(azimuth_deg * std::acos(-1.0) / 180);
    EXPECT_EQ(found.points[k].azimuth_deg, azimuth_deg);
    EXPECT_NEAR(found.distance_m[k], distance, 1e-6);
    EXPECT_NEAR(found.points[k].elevation_deg, elevation_deg(498, distance), 1e-9);
  }
  EXPECT_EQ(found.points[9].elevation_deg, 0);  // west: the plain falls below the level
  EXPECT_EQ(found.distance_m[9], 0);
  EXPECT_NEAR(found.looked_to_m[9], 200.5 * 50, 1e-6);
}

TEST(LandHorizon, SinksWithTheEarth) {
  const Raster raster = plain_with_ridge(120, 500, 50e3, 1000);
  const LandHorizon found = land_horizon(
      "dem", raster, 1, {.place = {0, 0, 0}, .above_m = 0, .to_m = 60e3, .step_deg = 90});
  EXPECT_NEAR(found.points[1].elevation_deg, elevation_deg(1000, 50e3), 1e-9);
  // Twin: a flat Earth would be noticed.
  EXPECT_GT(
      std::abs(found.points[1].elevation_deg - std::atan2(1000, 50e3) * 180 / std::acos(-1.0)),
      0.15);
}

// Crests of one cell are as high at every azimuth, wherever the ray crosses them.
TEST(LandHorizon, MeetsTheCrestOfARidgeOfOneCell) {
  Raster raster = plain_with_ridge(150, 100, 5000, 500);
  for (std::size_t i = 0; i < raster.values.size(); ++i)
    if (i % raster.columns > 200) raster.values[i] = plain_m;
  const LandHorizon found = land_horizon("dem", raster, 1, {.place = {0, 0, 0}});
  for (std::size_t azimuth = 46; azimuth < 135; ++azimuth) {
    const double distance = 5000 / std::sin(static_cast<double>(azimuth) * std::acos(-1.0) / 180);
    EXPECT_NEAR(found.points[azimuth].elevation_deg, elevation_deg(498, distance), 1e-9);
    EXPECT_NEAR(found.distance_m[azimuth], distance, 1e-6);
  }
}

// Between four middles that are in no plane a ray may have its top inside.
TEST(LandHorizon, FindsTopsBetweenTheMiddlesOfCells) {
  Raster raster;
  raster.columns = raster.rows = 41;
  raster.file_from_cell = {-2100, 100, 17, 1900, -9, -95};  // sheared and turned
  for (std::size_t row = 0; row < raster.rows; ++row)
    for (std::size_t column = 0; column < raster.columns; ++column)
      raster.values.push_back(plain_m + 150.0 * static_cast<double>((row ^ column) & 1) *
                                            static_cast<double>((row * 7 + column * 3) % 11) / 11);
  const LandView view{.place = {30, -20, 0}, .from_m = 300, .step_deg = 7.5};
  const LandHorizon found = land_horizon("dem", raster, 1, view);
  const double eye = found.land_m + view.above_m, step_m = 0.02;
  std::size_t inside = 0;
  for (std::size_t k = 0; k < found.points.size(); ++k) {
    const Vec3 way = enu_direction({found.points[k].azimuth_deg, 0});
    const auto height = [&](double d) {
      return height_between_cells(raster, 1, view.place.x + d * way.x, view.place.y + d * way.y)
          .value_or(0);
    };
    double highest = 0;
    for (double d = view.from_m; d <= found.looked_to_m[k]; d += step_m)
      highest = std::max(highest, elevation_deg(height(d) - eye, d));
    const double top = found.points[k].elevation_deg, at = found.distance_m[k];
    EXPECT_GT(top, highest - 1e-9) << k;
    EXPECT_LT(top, highest + 0.002) << k;  // at a kink, within half a step
    EXPECT_NEAR(top, elevation_deg(height(at) - eye, at), 1e-9) << k;
    const double bend = (height(at + 0.5) - 2 * height(at) + height(at - 0.5)) / 0.25;
    if (std::abs(bend) < 0.1) ++inside;  // no kink
  }
  EXPECT_GT(inside, 5u);
}

TEST(LandHorizon, TurnsWithTheNorthOfTheMap) {
  const Raster raster = plain_with_ridge(200, 50, 5000, 500);
  const LandView straight{.place = {0, 0, 0}, .step_deg = 1};
  LandView turned = straight;
  turned.grid_north_deg = 20;  // the map's +y looks to azimuth 20: what is at 90 there is at 110
  const auto a = land_horizon("dem", raster, 1, straight),
             b = land_horizon("dem", raster, 1, turned);
  for (std::size_t k = 0; k < 360; ++k)
    EXPECT_NEAR(b.points[(k + 20) % 360].elevation_deg, a.points[k].elevation_deg, 1e-9) << k;
}

TEST(LandHorizon, LeavesOutWhatIsNearAndWhatHasNoData) {
  Raster raster = plain_with_ridge(200, 50, 5000, 500);
  EXPECT_EQ(
      land_horizon("dem", raster, 1, {.place = {0, 0, 0}, .to_m = 4000}).points[90].elevation_deg,
      0);
  const auto beyond = land_horizon("dem", raster, 1, {.place = {0, 0, 0}, .from_m = 8000});
  EXPECT_NEAR(beyond.distance_m[90], 8000, 1e-9);
  for (double& height : raster.values)
    if (height > plain_m) height = std::nan("");
  EXPECT_EQ(land_horizon("dem", raster, 1, {.place = {0, 0, 0}}).points[90].elevation_deg, 0);
  EXPECT_NE(refusal_of([&] {
              land_horizon("dem", raster, 1, {.place = {6000, 0, 0}});
            }).find("dem: the place"),
            std::string::npos);
  EXPECT_NE(refusal_of([&] {
              land_horizon("dem", raster, 1, {.place = {60000, 0, 0}});
            }).find("outside"),
            std::string::npos);
}

}  // namespace
}  // namespace sunload
