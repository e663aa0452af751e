// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Roofs that are sheets of their own.
#include "geo/mesh/roof_sheets.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/geo/mesh/mesh_prepare_models.h"

namespace sunload::test {
namespace {

constexpr double roof_rounding_m2 = 1e-6;

/// Four walls of 8 x 6 x 3 m.
ModelBuilder four_walls() {
  ModelBuilder model;
  model.object("house");
  const auto faces = ModelBuilder::box_faces({0, 0, 0}, {8, 6, 3});
  for (std::size_t k = 2; k < faces.size(); ++k) model.ring(faces[k]);
  return model;
}

/// Level, from 1 m beyond the walls on all sides.
ModelBuilder& add_plate(ModelBuilder& model, double z, double beyond_m = 1) {
  const double b = beyond_m;
  return model.ring({{-b, -b, z}, {8 + b, -b, z}, {8 + b, 6 + b, z}, {-b, 6 + b, z}});
}

double roof_m2(const ModelBuilder& model) { return area_of(model.prepared(), Surface::roof); }

TEST(RoofSheets, LieOnWallsAndReachBeyondThem) {
  auto model = four_walls();
  EXPECT_NEAR(roof_m2(add_plate(model, 3)), 10 * 8, roof_rounding_m2);
}

TEST(RoofSheets, MayBeThickerThanASheetAndOfAnotherObject) {
  auto model = four_walls();
  model.object("roof");
  EXPECT_NEAR(roof_m2(add_plate(model, 3.3)), 10 * 8, roof_rounding_m2);
}

TEST(RoofSheets, LieOnClosedHousesToo) {
  ModelBuilder model;
  model.object("house").box({0, 0, 0}, {8, 6, 3});
  model.object("roof").ring({{-1, -1, 2.9}, {9, -1, 2.9}, {9, 3, 5}, {-1, 3, 5}});
  model.ring({{-1, 3, 5}, {9, 3, 5}, {9, 7, 2.9}, {-1, 7, 2.9}});
  const double slope = std::hypot(4, 2.1) / 4;
  EXPECT_NEAR(roof_m2(model), 8 * 6 + 10 * 8 * slope, roof_rounding_m2);
}

TEST(RoofSheets, LieBetweenParapets) {
  auto model = four_walls();
  EXPECT_NEAR(roof_m2(add_plate(model, 2.2, 0)), 8 * 6, roof_rounding_m2);
}

// A terrain that is cut out around a house which is sunk into it.
TEST(RoofSheets, AreNoTerrainThatEndsAtWalls) {
  auto model = four_walls();
  model.object("terrain").polygon({{{-2, -2, 2.2}, {10, -2, 2.2}, {10, 8, 2.2}, {-2, 8, 2.2}},
                                   {{0, 0, 2.2}, {0, 6, 2.2}, {8, 6, 2.2}, {8, 0, 2.2}}});
  EXPECT_EQ(roof_m2(model), 0);
}

TEST(RoofSheets, AreNoneThatHangHigherOrLower) {
  for (const double z : {2.5, 3.8, 6.0}) {  // its edges 1 m beyond the walls
    auto model = four_walls();
    EXPECT_EQ(roof_m2(add_plate(model, z)), 0) << z;
  }
}

TEST(RoofSheets, AreNoSlabsBetweenStoreys) {
  auto model = four_walls();
  add_plate(model, 3, 0.01);
  const auto upper = ModelBuilder::box_faces({0, 0, 3}, {8, 6, 6});
  for (std::size_t k = 2; k < upper.size(); ++k) model.ring(upper[k]);
  EXPECT_NEAR(roof_m2(add_plate(model, 6)), 10 * 8, roof_rounding_m2);
}

TEST(RoofSheets, AreNoTerrainThatAWallHolds) {
  ModelBuilder model;
  model.object("wall").ring({{0, 0, 0}, {20, 0, 0}, {20, 0, 3}, {0, 0, 3}});
  model.object("terrace").ring({{-20, 0, 3}, {40, 0, 3}, {40, 60, 3}, {-20, 60, 3}});
  EXPECT_EQ(roof_m2(model), 0);
}

TEST(RoofSheets, AreNoTerrainOnWhichWallsStand) {
  auto model = four_walls();
  model.object("terrain");
  EXPECT_EQ(roof_m2(add_plate(model, 0, 30)), 0);
}

}  // namespace
}  // namespace sunload::test
