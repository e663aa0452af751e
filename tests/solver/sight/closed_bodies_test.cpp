// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/closed_bodies.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/scenes.h"

namespace sunload::test {
namespace {

std::vector<Closed> bodies_of(const Scene& scene, const std::vector<float>& transmittance = {}) {
  return closed_bodies(Occluders(scene.mesh, transmittance)).turned;
}

SceneBuilder boxes(std::initializer_list<std::pair<Vec3, Vec3>> all, SceneBuilder::Facing facing) {
  SceneBuilder b;
  const int grey = b.material({"grey", 0.3, 0, 0});
  for (const auto& [low, high] : all) b.box(low, high, grey, facing);
  return b;
}

TEST(ClosedBodies, KnowWhichWayTheyAreTurned) {
  const std::pair<Vec3, Vec3> box{{100, 200, 0}, {103, 204, 5}};
  EXPECT_EQ(bodies_of(boxes({box}, SceneBuilder::Facing::outward).scene()),
            std::vector<Closed>(12, Closed::outward));
  EXPECT_EQ(bodies_of(boxes({box}, SceneBuilder::Facing::inward).scene()),
            std::vector<Closed>(12, Closed::inward));
}

/// Two houses that touch along a corner: their edge is passed twice in either direction.
TEST(ClosedBodies, MayTouchAlongEdges) {
  const auto scene =
      boxes({{{0, 0, 0}, {2, 2, 5}}, {{2, 2, 0}, {4, 4, 5}}}, SceneBuilder::Facing::outward)
          .scene();
  EXPECT_EQ(bodies_of(scene), std::vector<Closed>(24, Closed::outward));
}

TEST(ClosedBodies, HaveNoHole) {
  auto b = boxes({{{0, 0, 0}, {2, 2, 5}}, {{10, 0, 0}, {12, 2, 5}}}, SceneBuilder::Facing::outward);
  Scene open = b.scene();
  open.mesh.triangles[3] = {0, 0, 0};
  const auto bodies = bodies_of(open);
  EXPECT_EQ(std::count(bodies.begin(), bodies.begin() + 12, Closed::no), 12);
  EXPECT_EQ(std::count(bodies.begin() + 12, bodies.end(), Closed::outward), 12);
}

/// One side looks the other way.
TEST(ClosedBodies, AreTurnedAlikeAllOver) {
  Scene scene = boxes({{{0, 0, 0}, {2, 2, 5}}}, SceneBuilder::Facing::outward).scene();
  std::swap(scene.mesh.triangles[0][0], scene.mesh.triangles[0][1]);
  EXPECT_EQ(bodies_of(scene), std::vector<Closed>(12, Closed::no));
}

TEST(ClosedBodies, LetNoLightPass) {
  std::vector<float> transmittance(12, 0);
  transmittance[7] = 0.5f;
  const auto scene = boxes({{{0, 0, 0}, {2, 2, 5}}}, SceneBuilder::Facing::outward).scene();
  EXPECT_EQ(bodies_of(scene, transmittance), std::vector<Closed>(12, Closed::no));
}

}  // namespace
}  // namespace sunload::test
