// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/convex_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/support/scenes.h"

namespace sunload::test {
namespace {

constexpr double flat = 1e-5;
constexpr std::size_t most_corners = 15;

std::vector<ConvexFace> faces_of(const Scene& scene, const std::vector<float>& transmittance = {},
                                 std::size_t most = most_corners) {
  return convex_faces(Occluders(scene.mesh, transmittance), flat, most);
}

double area_of(const ConvexFace& face) {
  Vec3 twice{0, 0, 0};
  for (std::size_t k = 2; k < face.corners.size(); ++k)
    twice += cross(face.corners[k - 1] - face.corners[0], face.corners[k] - face.corners[0]);
  return dot(twice, face.normal) / 2;
}

std::vector<double> areas_of(const std::vector<ConvexFace>& faces) {
  std::vector<double> areas;
  for (const ConvexFace& face : faces) areas.push_back(area_of(face));
  std::sort(areas.begin(), areas.end());
  return areas;
}

TEST(ConvexFaces, OfABoxAreItsSides) {
  SceneBuilder b;
  b.box({0, 0, 0}, {2, 3, 5}, b.material({"grey", 0.3, 0, 0}), SceneBuilder::Facing::outward);
  const auto areas = areas_of(faces_of(b.scene()));
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
  const auto areas = areas_of(faces_of(b.scene()));
  EXPECT_GE(areas.size(), 2u);
  EXPECT_LE(areas.back(), 2 + 1e-9);
  EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), 3, 1e-9);
}

TEST(ConvexFaces, AFoldIsNotFlatAndAScreenIsNoFace) {
  SceneBuilder b;
  const int grey = b.material({"grey", 0.3, 0, 0});
  b.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, grey);
  b.quad({1, 0, 0}, {2, 0, 0.01}, {2, 1, 0.01}, {1, 1, 0}, grey);
  EXPECT_EQ(faces_of(b.scene()).size(), 2u);
  EXPECT_EQ(faces_of(b.scene(), {0, 0, 0.5f, 0.5f}).size(), 1u);
}

TEST(ConvexFaces, KnowTheirTrianglesAndHaveNoCornersOnStraightEdges) {
  SceneBuilder b;
  const int grey = b.material({"grey", 0.3, 0, 0});
  for (int i = 0; i < 5; ++i)
    b.quad({i * 1.0, 0, 0}, {i + 1.0, 0, 0}, {i + 1.0, 1, 0}, {i * 1.0, 1, 0}, grey);
  const auto faces = faces_of(b.scene());
  ASSERT_EQ(faces.size(), 1u);
  EXPECT_EQ(faces[0].corners.size(), 4u);
  std::vector<std::uint32_t> all(10);
  std::iota(all.begin(), all.end(), 0u);
  EXPECT_EQ(faces[0].triangles, all);
}

/// A disk of 24 triangles about its middle.
TEST(ConvexFaces, HaveNoMoreCornersThanTheyMay) {
  SceneBuilder b;
  const int grey = b.material({"grey", 0.3, 0, 0});
  const auto rim = [](int k) {
    const double angle = 2 * pi * (k % 24) / 24;
    return Vec3{std::cos(angle), std::sin(angle), 0};
  };
  for (int k = 0; k < 24; ++k) b.triangle({0, 0, 0}, rim(k), rim(k + 1), grey);
  double sum = 0;
  for (const auto& face : faces_of(b.scene(), {}, 8)) {
    EXPECT_LE(face.corners.size(), 8u);
    sum += area_of(face);
  }
  EXPECT_NEAR(sum, 12 * std::sin(2 * pi / 24), 1e-9);
}

}  // namespace
}  // namespace sunload::test
