// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Open land has points everywhere, the closer together the nearer lines are, and no needles.
#include "geo/mesh/land_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geo/mesh/land.h"

namespace sunload::test {
namespace {

constexpr double foot_m = 8;

/// Rows of square feet, each at a height of its own, and one alone.
LandLines feet_of_rows() {
  LandLines lines;
  lines.x0 = -200, lines.x1 = 500, lines.y0 = -150, lines.y1 = 400;
  const auto add = [&](double x, double y, double z) {
    const Vec3 corners[] = {
        {x, y, z}, {x + foot_m, y, z}, {x + foot_m, y + foot_m, z}, {x, y + foot_m, z}};
    for (std::size_t k = 0; k < 4; ++k) {
      lines.feet.push_back({corners[k], corners[(k + 1) % 4]});
      lines.foot_body.push_back(static_cast<std::int32_t>(lines.feet.size() / 4));
    }
  };
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 3; ++j) add(foot_m * i, 30.0 * j, 0.1 * i + 0.3 * j);
  add(250, 200, 2);
  return lines;
}

Box rectangle_of(const LandLines& lines) {
  return {{lines.x0, lines.y0, 0}, {lines.x1, lines.y1, 0}};
}

/// By the definition: the nearest of all lines.
double distance_to(const LandLines& lines, Vec3 p) {
  double least = 1e300;
  for (const auto& [a, b] : lines.feet) {
    const Vec3 along = Vec3{b.x - a.x, b.y - a.y, 0}, from{p.x - a.x, p.y - a.y, 0};
    const double s = std::clamp(dot(from, along) / dot(along, along), 0.0, 1.0);
    least = std::min(least, norm(from - s * along));
  }
  return least;
}

double spacing(const std::vector<Vec3>& points, std::size_t i) {
  double least = 1e300;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (k != i) least = std::min(least, norm(points[k] - points[i]));
  return least;
}

TEST(OpenLandPoints, AreAsFarFromEachOtherAsFromLines) {
  const LandLines lines = feet_of_rows();
  const auto points = open_land_points(lines, rectangle_of(lines));
  ASSERT_GT(points.size(), 100u);
  EXPECT_LT(points.size(), 1000u);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double away = distance_to(lines, points[i]), next = spacing(points, i);
    EXPECT_GE(away, foot_m / 2);
    EXPECT_GE(next, foot_m);
    // A cell that is not split is no wider than that; its neighbours are split once more at most.
    EXPECT_LE(next, 2 * std::max(away, foot_m));
    EXPECT_GE(next, away / 4);
  }
}

TEST(OpenLandPoints, AreWhereverThereIsRoom) {
  const LandLines lines = feet_of_rows();
  const auto points = open_land_points(lines, rectangle_of(lines));
  for (double x = lines.x0 + 100; x < lines.x1 - 100; x += 7)
    for (double y = lines.y0 + 100; y < lines.y1 - 100; y += 7) {
      const double away = distance_to(lines, {x, y, 0});
      if (away < foot_m) continue;
      double least = 1e300;
      for (const Vec3& p : points) least = std::min(least, norm(p - Vec3{x, y, 0}));
      EXPECT_LE(least, 2 * away) << x << ' ' << y;
    }
}

TEST(OpenLandPoints, AreNoneWithoutFeet) {
  LandLines lines;
  lines.x1 = lines.y1 = 100;
  EXPECT_TRUE(open_land_points(lines, rectangle_of(lines)).empty());
}

/// Without points on open land the longest triangle from foot to foot is over a hundred metres.
TEST(OpenLandPoints, LeaveNoNeedles) {
  const LandLines lines = feet_of_rows();
  const Land land = triangulate_land(lines);
  std::size_t near_feet = 0;
  for (const auto& t : land.triangles) {
    double longest = 0, away = 1e300;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 a = land.points[static_cast<std::size_t>(t[k])],
                 b = land.points[static_cast<std::size_t>(t[(k + 1) % 3])];
      longest = std::max(longest, std::hypot(b.x - a.x, b.y - a.y));
      away = std::min(away, distance_to(lines, a));
    }
    if (away > 0) continue;
    ++near_feet;
    EXPECT_LE(longest, 5 * foot_m);
  }
  EXPECT_GT(near_feet, 4 * 37u);
}

}  // namespace
}  // namespace sunload::test
