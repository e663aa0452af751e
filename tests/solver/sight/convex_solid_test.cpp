// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/convex_solid.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sunload::test {
namespace {

/// 2 × 4 × 6 m about (1, 2, 3).
ConvexSolid box() {
  return ConvexSolid({1, 2, 3}, {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}, {1, 2, 3});
}

TEST(ConvexSolid, OfSixSides) {
  EXPECT_NEAR(box().volume(), 48, 1e-12);
  const auto frame = box().frame(1e-6);
  EXPECT_EQ(frame.corners.size(), 8u);
  EXPECT_EQ(frame.edges.size(), 12u);
  EXPECT_TRUE(box().has_within({1, 2, 3}, 0.99));
  EXPECT_FALSE(box().has_within({1, 2, 3}, 1.01));
}

/// A ridge along y: a quarter of the box lies above the two slopes.
TEST(ConvexSolid, CutBySlopes) {
  ConvexSolid house = box();
  const double k = 1 / std::sqrt(10.0);  // from the eaves at z = 3 to a ridge at z = 6
  for (const double side : {-1.0, 1.0}) {
    const Vec3 normal{side * 3 * k, 0, k};
    house.cut({normal, dot(normal, {1, 0, 6})});
  }
  EXPECT_NEAR(house.volume(), 36, 1e-9);
  const auto frame = house.frame(1e-6);
  EXPECT_EQ(house.sides().size(), 7u);
  EXPECT_EQ(frame.corners.size(), 10u);
  EXPECT_EQ(frame.edges.size(), 15u);  // Euler: 10 - 15 + 7 = 2
}

TEST(ConvexSolid, PlanesBesideItChangeNothingAndThoseBeforeItLeaveNothing) {
  ConvexSolid solid = box();
  solid.cut({{0, 0, 1}, 7});
  EXPECT_EQ(solid.sides().size(), 6u);
  EXPECT_NEAR(solid.volume(), 48, 1e-12);
  solid.cut({{0, 0, 1}, -1});
  EXPECT_TRUE(solid.sides().empty());
  EXPECT_EQ(solid.volume(), 0);
  solid.cut({{0, 0, 1}, -2});
  EXPECT_EQ(solid.volume(), 0);
}

TEST(ConvexSolid, KnowsWhatOfAPolygonIsWithin) {
  const std::vector<Vec3> square{{-5, -5, 3}, {5, -5, 3}, {5, 5, 3}, {-5, 5, 3}};
  EXPECT_EQ(box().part_within(square, 0.5).size(), 4u);  // 1 x 3 m
  const std::vector<Vec3> above{{-5, -5, 5.8}, {5, -5, 5.8}, {5, 5, 5.8}, {-5, 5, 5.8}};
  EXPECT_LT(box().part_within(above, 0.5).size(), 3u);
  EXPECT_EQ(box().part_within(above, 0.1).size(), 4u);
}

}  // namespace
}  // namespace sunload::test
