// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/plane_groups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/scenes.h"

namespace sunload::test {
namespace {

constexpr double flat_m = 1e-4;

/// A scene in patches of that edge, its faces and groups.
struct Grouped {
  Scene scene;
  Hierarchy mesh;
  SunFaces faces;
  PlaneGroups groups;
  Grouped(const SceneBuilder& b, double max_edge_m)
      : scene(b.scene()),
        mesh(scene, {.max_edge_m = max_edge_m}),
        faces(scene, flat_m),
        groups(scene, mesh, faces) {}
};

double area_of(std::span<const Vec3> corners) {
  Vec3 twice{0, 0, 0};
  for (std::size_t k = 2; k < corners.size(); ++k)
    twice += cross(corners[k - 1] - corners[0], corners[k] - corners[0]);
  return norm(twice) / 2;
}

/// Each patch is in one group, in its plane, and the polygon is as large as its patches.
void expect_sound(const Grouped& of) {
  std::vector<int> times(of.mesh.patch_count());
  for (const PlaneGroups::Group& group : of.groups.all()) {
    double area = 0;
    for (const auto patch : of.groups.patches_of(group)) {
      ++times[patch];
      area += of.mesh.area()[patch];
      EXPECT_NEAR(norm(of.mesh.normal(patch) - group.normal), 0, 1e-6);
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(dot(group.normal, of.mesh.corner(patch, k)), group.plane_offset, 1e-6);
    }
    EXPECT_NEAR(area_of(of.groups.corners_of(group)), area, 1e-9 * area);
  }
  EXPECT_TRUE(std::all_of(times.begin(), times.end(), [](int n) { return n == 1; }));
}

TEST(PlaneGroups, AreFacesOfFewPatches) {
  SceneBuilder b;
  b.box({0, 0, 0}, {2, 3, 5}, b.material({"grey", 0.3, 0, 0}), SceneBuilder::Facing::outward);
  const Grouped box(b, 3);
  expect_sound(box);
  EXPECT_EQ(box.groups.all().size(), 6u);
}

TEST(PlaneGroups, ArePartsOfTrianglesOfMany) {
  SceneBuilder b;
  b.quad({0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}, b.material({"grey", 0.3, 0, 0}));
  const Grouped square(b, 1);
  expect_sound(square);
  for (const PlaneGroups::Group& group : square.groups.all()) {
    EXPECT_LE(group.count, 32u);
    EXPECT_GE(group.count, 16u);  // or two of them would be one
    EXPECT_EQ(group.corner_count, 3u);
  }
}

/// What one of them receives is not what the other does, and mirrors are told by rays.
TEST(PlaneGroups, HaveOneSideAndKindOfSurface) {
  SceneBuilder b;
  const int grey = b.material({"grey", 0.3, 0, 0}), mirror = b.material({"mirror", 0, 0.8, 0});
  b.sides(Sides::two).quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, grey);
  b.sides(Sides::one).quad({1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, mirror);
  const Grouped sheet(b, 3);
  // One face of all four triangles
  EXPECT_EQ(sheet.faces.of_triangle(0), sheet.faces.of_triangle(3));
  ASSERT_EQ(sheet.groups.all().size(), 3u);
  std::size_t mirrors = 0, below = 0;
  for (const PlaneGroups::Group& group : sheet.groups.all()) {
    EXPECT_EQ(group.count, 2u);
    mirrors += group.sends_on ? 1 : 0;
    below += group.normal.z < 0 ? 1 : 0;
    // The outline is that of the face: more than its patches, never less.
    EXPECT_NEAR(area_of(sheet.groups.corners_of(group)), 2, 1e-9);
  }
  EXPECT_EQ(mirrors, 1u);
  EXPECT_EQ(below, 1u);
}

/// Within the flatness of faces, but not in one plane.
TEST(PlaneGroups, HaveOnePlane) {
  SceneBuilder b;
  const int grey = b.material({"grey", 0.3, 0, 0});
  b.triangle({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, grey);
  b.triangle({0, 0, 0}, {1, 1, 0}, {0, 1, flat_m / 2}, grey);
  const Grouped bent(b, 3);
  EXPECT_EQ(bent.faces.of_triangle(0), bent.faces.of_triangle(1));
  expect_sound(bent);
  EXPECT_EQ(bent.groups.all().size(), 2u);
}

/// Of screens, through which light passes, no face tells.
TEST(PlaneGroups, OfScreensAreTriangles) {
  SceneBuilder b;
  b.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
         b.material({.name = "hedge", .diffuse = 0.1, .transmittance = 0.5}));
  const Grouped hedge(b, 3);
  expect_sound(hedge);
  EXPECT_EQ(hedge.faces.of_triangle(0), SunFaces::none);
  EXPECT_EQ(hedge.groups.all().size(), 2u);
}

}  // namespace
}  // namespace sunload::test
