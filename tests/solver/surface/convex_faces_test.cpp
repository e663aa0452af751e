// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/surface/convex_faces.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/scenes.h"

namespace sunload::test {
namespace {

constexpr double flat = 1e-5;

std::vector<double> areas_of(const Scene& scene, const std::vector<float>& transmittance = {}) {
  std::vector<double> areas;
  for (const ConvexFace& face : convex_faces(Occluders(scene.mesh, transmittance), flat))
    areas.push_back(area_of(face));
  std::sort(areas.begin(), areas.end());
  return areas;
}

TEST(ConvexFaces, OfABoxAreItsSides) {
  SceneBuilder b;
  b.box({0, 0, 0}, {2, 3, 5}, b.material({"grey", 0.3, 0, 0}), SceneBuilder::Facing::outward);
  const auto areas = areas_of(b.scene());
  const std::vector<double> sides{6, 6, 10, 10, 15, 15};
  ASSERT_EQ(areas.size(), sides.size());
  for (std::size_t i = 0; i < sides.size(); ++i) EXPECT_NEAR(areas[i], sides[i], 1e-9);
}

/// An L of three squares in six triangles: no convex face has more than two of them.
TEST(ConvexFaces, OfAnLAreMoreThanOne) {
  SceneBuilder b;
  const int grey = b.material({"grey", 0.3, 0, 0});
  b.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, grey);
  b.quad({1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, grey);
  b.quad({0, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}, grey);
  const auto areas = areas_of(b.scene());
  EXPECT_GE(areas.size(), 2u);
  EXPECT_LE(areas.back(), 2 + 1e-9);
  double sum = 0;
  for (const double area : areas) sum += area;
  EXPECT_NEAR(sum, 3, 1e-9);
}

TEST(ConvexFaces, AFoldIsNotFlatAndAScreenIsNoFace) {
  SceneBuilder b;
  const int grey = b.material({"grey", 0.3, 0, 0});
  b.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, grey);
  b.quad({1, 0, 0}, {2, 0, 0.01}, {2, 1, 0.01}, {1, 1, 0}, grey);
  EXPECT_EQ(areas_of(b.scene()).size(), 2u);
  EXPECT_EQ(areas_of(b.scene(), {0, 0, 0.5f, 0.5f}).size(), 1u);
}

TEST(ConvexFaces, DrawnInTheyLoseTheirRim) {
  const ConvexFace square{{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, {0, 0, 1}};
  EXPECT_NEAR(area_of(inset(square, 0.5)), 9, 1e-12);
  EXPECT_TRUE(inset(square, 2.5).corners.empty());
}

}  // namespace
}  // namespace sunload::test
