// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/polygon_match.h"

#include <gtest/gtest.h>

namespace sunload {
namespace {

std::vector<Vec3> rectangle(double x0, double y0, double x1, double y1, double z) {
  return {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
}

TEST(PolygonMatch, TellsNeighboursInAPlaneApartAndLeavesHolesOut) {
  const PolygonMatch match({{rectangle(0, 0, 10, 10, 3), rectangle(4, 4, 6, 6, 3)},
                            {rectangle(10, 0, 20, 10, 3)},
                            {rectangle(4, 4, 6, 6, 3)}});
  const Vec3 up{0, 0, 1};
  EXPECT_EQ(match.polygon_at({1, 1, 3}, up), 0u);
  EXPECT_EQ(match.polygon_at({11, 1, 3}, up), 1u);
  EXPECT_EQ(match.polygon_at({5, 5, 3}, up), 2u);   // fills the hole
  EXPECT_EQ(match.polygon_at({1, 1, 3}, -up), 0u);  // repairs may turn a face
  EXPECT_FALSE(match.polygon_at({21, 1, 3}, up));
  EXPECT_FALSE(match.polygon_at({1, 1, 3.1}, up));
  EXPECT_FALSE(match.polygon_at({1, 1, 3}, {1, 0, 0}));
}

TEST(PolygonMatch, SeesUprightPolygonsAndTakesTheNearest) {
  const auto wall = [](double x) {
    return PolygonRings{{{x, 0, 0}, {x, 8, 0}, {x, 8, 6}, {x, 0, 6}}};
  };
  const PolygonMatch match({wall(0), wall(0.015), wall(5)});
  const Vec3 east{1, 0, 0};
  EXPECT_EQ(match.polygon_at({0.004, 2, 3}, east), 0u);
  EXPECT_EQ(match.polygon_at({0.012, 2, 3}, east), 1u);
  EXPECT_EQ(match.polygon_at({5, 7.9, 5.9}, east), 2u);
  EXPECT_FALSE(match.polygon_at({5, 7.9, 6.1}, east));
}

TEST(PolygonMatch, HoldsFacesOfAPolygonOutOfPlane) {
  // One corner is lifted: the two triangles lie on both sides of the mean plane.
  const PolygonMatch match({{{{0, 0, 0}, {10, 0, 0}, {10, 10, 1}, {0, 10, 0}}}});
  const Vec3 normal = normalized(cross(Vec3{10, 0, 0}, Vec3{10, 10, 1}));
  EXPECT_EQ(match.polygon_at({20.0 / 3, 10.0 / 3, 1.0 / 3}, normal), 0u);
  EXPECT_FALSE(match.polygon_at({20.0 / 3, 10.0 / 3, 3}, normal));
}

TEST(PolygonMatch, HasNothingToSayWithoutPolygons) {
  EXPECT_FALSE(PolygonMatch({}).polygon_at({0, 0, 0}, {0, 0, 1}));
  EXPECT_FALSE(
      PolygonMatch({{{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}}}).polygon_at({1, 1, 1}, {0, 0, 1}));
}

}  // namespace
}  // namespace sunload
