// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/body_cores.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geo/base/units.h"
#include "geo/mesh/mesh_prepare.h"
#include "io/scene/file.h"
#include "solver/base/spherical_triangle.h"
#include "solver/sight/sun_faces.h"
#include "tests/support/real_models.h"
#include "tests/support/scenes.h"
#include "tests/support/sights.h"

namespace sunload::test {
namespace {

constexpr double flat_within = 1e-5, away = 1e-4;

std::vector<BodyCore> cores_of(const Scene& scene, std::size_t faces_per_core = 1) {
  const Occluders occluders(scene.mesh, screens(scene).transmittance);
  const auto faces = convex_faces(occluders, flat_within, SunFaces::most_corners);
  return body_cores(occluders, closed_bodies(occluders), faces, away, faces_per_core);
}

/// Of its corners.
Vec3 middle_of(const BodyCore& core) {
  Vec3 sum{0, 0, 0};
  for (const Vec3& corner : core.corners) sum += corner / static_cast<double>(core.corners.size());
  return sum;
}

/// How often the closed bodies of a scene wind about a point.
double winding(const Mesh& mesh, Vec3 p) {
  double angle = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Vec3 a = mesh.corner(t, 0) - p, b = mesh.corner(t, 1) - p, c = mesh.corner(t, 2) - p;
    angle += std::copysign(SphericalTriangle(a, b, c).solid_angle(), dot(a, cross(b, c)));
  }
  return angle / (4 * pi);
}

/// Share of points between the corners of a core, `wider` times as far from its middle, that lie in
/// no body.
double share_outside(const Mesh& mesh, const std::vector<BodyCore>& cores, double wider = 1) {
  double points = 0, outside = 0;
  for (const BodyCore& core : cores) {
    const Vec3 middle = middle_of(core);
    for (const Vec3& a : core.corners)
      for (const Vec3& b : core.corners) {
        const Vec3 p = middle + ((a + b) * 0.5 - middle) * wider;
        ++points;
        outside += std::abs(winding(mesh, p)) < 0.5;
      }
  }
  return points > 0 ? outside / points : 0;
}

Vec3 extent_of(const BodyCore& core) {
  Vec3 low{1e300, 1e300, 1e300}, high = low * -1;
  for (const Vec3& p : core.corners) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return high - low;
}

/// Walls of a house over a footprint (counter-clockwise), roof and floor of triangles from its
/// first corner.
Scene prism(const std::vector<Vec3>& footprint, double height) {
  SceneBuilder b;
  const int grey = b.material({"grey", 0.3, 0, 0});
  const Vec3 up{0, 0, height};
  const std::size_t n = footprint.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 p = footprint[i], q = footprint[(i + 1) % n];
    b.quad(p, q, q + up, p + up, grey);
  }
  for (std::size_t i = 2; i < n; ++i) {
    b.triangle(footprint[0] + up, footprint[i - 1] + up, footprint[i] + up, grey);
    b.triangle(footprint[0], footprint[i], footprint[i - 1], grey);
  }
  return b.scene();
}

TEST(BodyCores, OfABoxIsTheBox) {
  for (const Scene& scene : {prism({{0, 0, 0}, {12, 0, 0}, {12, 8, 0}, {0, 8, 0}}, 9),
                             turned(prism({{0, 0, 0}, {12, 0, 0}, {12, 8, 0}, {0, 8, 0}}, 9))}) {
    const auto cores = cores_of(scene);
    ASSERT_EQ(cores.size(), 1u);
    EXPECT_EQ(cores[0].corners.size(), 8u);
    EXPECT_EQ(cores[0].edges.size(), 12u);
    for (const Vec3& corner : cores[0].corners) {
      double nearest = 1e300;
      for (const Vec3& vertex : scene.mesh.vertices)
        nearest = std::min(nearest, norm(corner - vertex));
      EXPECT_LT(nearest, 6 * away);
      EXPECT_GT(nearest, away);
    }
  }
}

/// Windows 15 cm deep in a wall: the core ends behind all of them.
TEST(BodyCores, EndBehindWhatIsCutIntoWalls) {
  const std::vector<Vec3> notched{{0, 0, 0}, {4, 0, 0},  {4, 0.15, 0}, {5, 0.15, 0},
                                  {5, 0, 0}, {12, 0, 0}, {12, 8, 0},   {0, 8, 0}};
  SceneBuilder b;  // the roof in convex parts
  const int grey = b.material({"grey", 0.3, 0, 0});
  for (std::size_t i = 0; i < notched.size(); ++i) {
    const Vec3 p = notched[i], q = notched[(i + 1) % notched.size()], up{0, 0, 9};
    b.quad(p, q, q + up, p + up, grey);
  }
  for (const double z : {0.0, 9.0})
    for (std::array<std::size_t, 3> t : {std::array<std::size_t, 3>{0, 1, 2},
                                         {0, 2, 7},
                                         {7, 2, 3},
                                         {7, 3, 6},
                                         {6, 3, 5},
                                         {3, 4, 5}}) {
      if (z == 0) std::swap(t[1], t[2]);
      b.triangle(notched[t[0]] + Vec3{0, 0, z}, notched[t[1]] + Vec3{0, 0, z},
                 notched[t[2]] + Vec3{0, 0, z}, grey);
    }
  const auto cores = cores_of(b.scene());
  ASSERT_EQ(cores.size(), 1u);
  EXPECT_NEAR(extent_of(cores[0]).x, 12, 0.01);
  EXPECT_NEAR(extent_of(cores[0]).y, 8 - 0.15, 0.01);
  EXPECT_NEAR(extent_of(cores[0]).z, 9, 0.01);
}

/// Two wings: no convex solid is in both of them all over, two hold everything.
TEST(BodyCores, OfAnLAreItsWings) {
  const Scene scene =
      prism({{0, 0, 0}, {20, 0, 0}, {20, 6, 0}, {6, 6, 0}, {6, 20, 0}, {0, 20, 0}}, 8);
  const auto cores = cores_of(scene);
  ASSERT_EQ(cores.size(), 2u);
  double area = 0;
  for (const BodyCore& core : cores) area += extent_of(core).x * extent_of(core).y;
  EXPECT_NEAR(area, 20 * 6 + 6 * 14, 0.1);
  EXPECT_EQ(share_outside(scene.mesh, cores), 0);
  EXPECT_GT(share_outside(scene.mesh, cores, 1.1), 0);  // what lies outside is seen to
}

TEST(BodyCores, AreForBodiesOfManyFaces) {
  const Scene scene = prism({{0, 0, 0}, {12, 0, 0}, {12, 8, 0}, {0, 8, 0}}, 9);
  EXPECT_EQ(cores_of(scene, 6).size(), 1u);
  EXPECT_TRUE(cores_of(scene, 7).empty());
}

TEST(BodyCores, WhatIsOpenHasNone) {
  Scene scene = prism({{0, 0, 0}, {12, 0, 0}, {12, 8, 0}, {0, 8, 0}}, 9);
  scene.mesh.triangles[0] = {0, 0, 0};
  EXPECT_TRUE(cores_of(scene).empty());
}

/// A room whose walls look inward is as dark within them as a house; of two boxes that touch along
/// an edge one may look inward: what hangs together by that edge is one body.
TEST(BodyCores, LieWhereFacesEncloseThemWhicheverWayTheyLook) {
  SceneBuilder b;
  const int grey = b.material({"grey", 0.3, 0, 0});
  b.box({0, 0, 0}, {10, 10, 10}, grey, SceneBuilder::Facing::outward);
  b.box({10, 10, 0}, {16, 16, 6}, grey, SceneBuilder::Facing::inward);
  const Scene scene = b.scene();
  const auto cores = cores_of(scene);
  EXPECT_GE(cores.size(), 1u);
  EXPECT_EQ(share_outside(scene.mesh, cores), 0);
}

/// Two boxes through each other, in one body by a common edge: its surface winds twice about what
/// is in both.
TEST(BodyCores, OfBodiesThatCrossThemselvesLieInside) {
  for (std::uint32_t number = 0; number < 8; ++number) {
    SceneBuilder b;
    const int grey = b.material({"grey", 0.3, 0, 0});
    const double k = number;
    b.box({0, 0, 0}, {10, 4 + k / 2, 5}, grey, SceneBuilder::Facing::outward);
    b.box({3 - k / 4, -4, 1}, {6, 9, 8 - k / 3}, grey, SceneBuilder::Facing::outward);
    b.box({10, 4 + k / 2, 0}, {14, 9 + k, 5}, grey, SceneBuilder::Facing::outward);
    const Scene scene = turned(b.scene());
    const auto cores = cores_of(scene);
    EXPECT_GE(cores.size(), 3u);
    EXPECT_EQ(share_outside(scene.mesh, cores), 0) << number;
  }
}

TEST(BodyCores, OfARealQuarterLieInsideAndHoldMostOfIt) {
  SUNLOAD_NEEDS_MODEL("data/city/lod2_100_buildings_v11_epsg3068.city.json");
  Scene scene;
  scene.mesh = prepare(read_scene_file(
                           shared_path("data/city/lod2_100_buildings_v11_epsg3068.city.json"), {}),
                       {})
                   .mesh;
  scene.materials = {{"grey", 0.3, 0, 0}};
  scene.material.assign(scene.mesh.triangle_count(), MaterialId{0});
  const auto cores = cores_of(scene);
  EXPECT_GE(cores.size(), 90u);  // of 100 houses
  EXPECT_EQ(share_outside(scene.mesh, cores), 0);
  EXPECT_GT(share_outside(scene.mesh, cores, 1.2), 0.1);
}

}  // namespace
}  // namespace sunload::test
