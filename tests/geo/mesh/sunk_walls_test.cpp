// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Walls below a terrain that nothing calls land.
#include "geo/mesh/sunk_walls.h"

#include <gtest/gtest.h>

#include "tests/geo/mesh/mesh_prepare_models.h"

namespace sunload::test {
namespace {

constexpr double sunk_rounding_m2 = 1e-6;

/// Half of them lie on a slope of 10 %, 50 m to each side.
ModelBuilder slope(const std::string& kind = "") {
  const auto at = [](double x, double y) { return Vec3{x, y, 0.1 * x}; };
  ModelBuilder builder;
  builder.object("terrain", kind).ring({at(-50, -50), at(50, -50), at(50, 50), at(-50, 50)});
  return builder;
}

TEST(SunkWalls, AreThoseBelowASheetThatReachesBeyondThem) {
  auto builder = slope();
  builder.object("house").box({-5, -5, -3}, {5, 5, 6});
  const SunkWalls sunk = builder.prepared().report.sunk;
  // As high as the terrain is at their feet: of both walls along the slope at one end or the other.
  constexpr double across = 10 * (2.5 + 3.5), along_least = 2 * 10 * 2.5, along_most = 2 * 10 * 3.5;
  EXPECT_GE(sunk.area_m2, across + along_least - sunk_rounding_m2);
  EXPECT_LE(sunk.area_m2, across + along_most + sunk_rounding_m2);
  EXPECT_EQ(sunk.sheet, "terrain");
  EXPECT_EQ(sunk.wall, "house");
}

TEST(SunkWalls, AreNoneWhereTheSheetIsCalledLand) {
  auto builder = slope("TINRelief");
  builder.object("house").box({-5, -5, -3}, {5, 5, 6});
  EXPECT_EQ(builder.prepared().report.sunk.area_m2, 0);
}

TEST(SunkWalls, AreNoneBelowBalconiesAndRoofs) {
  ModelBuilder builder;
  builder.object("house").box({-5, -5, 0}, {5, 5, 6});
  builder.object("balcony").ring({{4, -2, 3}, {7, -2, 3}, {7, 2, 3}, {4, 2, 3}});
  builder.object("carport").box({20, 0, 0}, {22, 2, 2});
  builder.object("its roof").ring({{18, -2, 3}, {24, -2, 3}, {24, 4, 3}, {18, 4, 3}});
  EXPECT_EQ(builder.prepared().report.sunk.area_m2, 0);
}

// A chimney goes through the eaves, a tower through a podium that has no floor.
TEST(SunkWalls, AreNoneBelowRoofsThatSomethingGoesThrough) {
  ModelBuilder builder;
  builder.object("house").box({-5, -5, 0}, {5, 5, 5});
  builder.object("roof").ring({{-6, -6, 6}, {6, -6, 6}, {6, 6, 7}, {-6, 6, 7}});
  builder.object("chimney").box({1, 1, 4}, {2, 2, 9});
  builder.object("podium").walls_and_roof({20, 0, 0}, {40, 20, 4});
  builder.object("tower").box({25, 5, 0}, {35, 15, 30});
  EXPECT_EQ(builder.prepared().report.sunk.area_m2, 0);
}

TEST(SunkWalls, AreNoneWhereHousesStandOnTheSheet) {
  ModelBuilder builder;
  builder.object("plate").ring({{-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}});
  builder.object("house").box({-5, -5, 0}, {5, 5, 6});
  EXPECT_EQ(builder.prepared().report.sunk.area_m2, 0);
}

}  // namespace
}  // namespace sunload::test
