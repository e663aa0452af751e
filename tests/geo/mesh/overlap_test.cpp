// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/overlap.h"

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace sunload::test {
namespace {

TEST(Overlap, OfTrianglesOfOnePlane) {
  const std::array<Vec3, 3> a{Vec3{0, 0, 1}, {2, 0, 1}, {0, 2, 1}};
  const Vec3 up{0, 0, 1};
  EXPECT_DOUBLE_EQ(overlap_m2(a, up, a), 2);
  EXPECT_DOUBLE_EQ(overlap_m2(a, up, {Vec3{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}), 0.5);
  // Turned by half: a square of 1 m in common.
  EXPECT_DOUBLE_EQ(overlap_m2(a, up, {Vec3{1, 1, 1}, {-1, 1, 1}, {1, -1, 1}}), 1);
  EXPECT_EQ(overlap_m2(a, up, {Vec3{2, 0, 1}, {2, 2, 1}, {0, 2, 1}}), 0);
  EXPECT_EQ(overlap_m2(a, up, {Vec3{5, 0, 1}, {7, 0, 1}, {5, 2, 1}}), 0);
}

void add_plate(SceneBuilder& b, const std::string& name, double side, double z, bool up) {
  b.object(name);
  if (up)
    b.quad({0, 0, z}, {side, 0, z}, {side, side, z}, {0, side, z}, 0);
  else
    b.quad({0, side, z}, {side, side, z}, {side, 0, z}, {0, 0, z}, 0);
}

Doubled of_plates(double z, bool up) {
  SceneBuilder b;
  b.material({"grey", 0.5, 0, 0});
  add_plate(b, "ground", 10, 0, true);
  add_plate(b, "plate", 4, z, up);
  return find_doubled(b.scene().mesh);
}

TEST(Doubled, IsWhatLiesInAnotherAndFacesTheSameWay) {
  const Doubled found = of_plates(0, true);
  EXPECT_NEAR(found.area_m2, 16, 1e-9);
  EXPECT_LT(found.first[0], 2u);
  EXPECT_GE(found.first[1], 2u);
}

TEST(Doubled, IsNothingBackToBackOrAMillimetreAbove) {
  EXPECT_EQ(of_plates(0, false).area_m2, 0);
  EXPECT_EQ(of_plates(1e-3, true).area_m2, 0);
}

TEST(Doubled, IsNothingOfNeighboursInAWall) {
  SceneBuilder b;
  b.material({"grey", 0.5, 0, 0});
  b.object("left").quad({0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}, 0);
  b.object("right").quad({1, 0, 0}, {2, 0, 0}, {2, 0, 1}, {1, 0, 1}, 0);
  EXPECT_EQ(find_doubled(b.scene().mesh).area_m2, 0);
}

}  // namespace
}  // namespace sunload::test
