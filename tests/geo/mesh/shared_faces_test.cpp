// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Bodies of one object that have a face in common, which looks the same way for both.
#include "geo/mesh/shared_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <utility>

#include "geo/mesh/covered.h"
#include "geo/mesh/slope.h"
#include "tests/geo/mesh/mesh_prepare_models.h"

namespace sunload::test {
namespace {

using Faces = std::vector<std::vector<Vec3>>;
using Corners = std::pair<Vec3, Vec3>;

constexpr double rounding_m2 = 1e-6;

Faces faces_of(const std::vector<Corners>& boxes) {
  Faces faces;
  for (const auto& [a, b] : boxes)
    for (const auto& face : ModelBuilder::box_faces(a, b)) faces.push_back(face);
  return faces;
}

PreparedMesh one_mesh(const Faces& faces) {
  ModelBuilder model;
  model.object("house");
  for (const auto& face : faces) model.ring(face);
  return model.prepared();
}

PreparedMesh own_objects(const std::vector<Corners>& boxes) {
  ModelBuilder model;
  for (std::size_t k = 0; k < boxes.size(); ++k)
    model.object("h" + std::to_string(k)).box(boxes[k].first, boxes[k].second);
  return model.prepared();
}

/// Of patches, but for what looks down [m2].
struct Open {
  double walls = 0, roofs = 0;
};
Open open_of(PreparedMesh p) {
  cut_covered(p.mesh, p.bodies, std::vector<std::uint8_t>(p.mesh.triangle_count(), 1));
  Open open;
  for (std::size_t t = 0; t < p.mesh.triangle_count(); ++t) {
    if (p.mesh.is_covered(t)) continue;
    if (const auto slope = slope_of(p.mesh, t); slope == Slope::upright)
      open.walls += p.mesh.area_m2(t);
    else if (slope == Slope::upward)
      open.roofs += p.mesh.area_m2(t);
  }
  return open;
}

/// The outline of a house and its higher part, both from the ground: they share the floor.
const std::vector<Corners> low_and_high{{{0, 0, 0}, {12, 8, 6}}, {{0, 0, 0}, {12, 8, 9}}};
/// They share the end wall.
const std::vector<Corners> wing_in_wing{{{0, 0, 0}, {10, 8, 6}}, {{4, 0, 0}, {10, 8, 6}}};
const std::vector<Corners> three_heights{
    {{0, 0, 0}, {12, 8, 6}}, {{0, 0, 0}, {12, 8, 9}}, {{0, 0, 0}, {12, 8, 3}}};
/// Another house stands against the shared end wall.
const std::vector<Corners> wings_and_neighbour{
    {{0, 0, 0}, {10, 8, 6}}, {{4, 0, 0}, {10, 8, 6}}, {{10, 0, 0}, {15, 8, 6}}};

TEST(SharedFaces, AreOfBothBodies) {
  for (const auto& boxes : {low_and_high, wing_in_wing, three_heights}) {
    const PreparedMesh p = one_mesh(faces_of(boxes));
    EXPECT_EQ(p.report.bodies_parted, boxes.size() - 1);
    EXPECT_EQ(p.report.closed_bodies, boxes.size());
    EXPECT_EQ(p.report.duplicates_dropped + p.report.open_sheets, 0u);
  }
  const Open of_high = open_of(one_mesh(faces_of(low_and_high)));
  EXPECT_NEAR(of_high.walls, 2 * (12 + 8) * 9, rounding_m2);
  EXPECT_NEAR(of_high.roofs, 12 * 8, rounding_m2);
  const Open of_wings = open_of(one_mesh(faces_of(wing_in_wing)));
  EXPECT_NEAR(of_wings.walls, 2 * (10 + 8) * 6, rounding_m2);
  EXPECT_NEAR(of_wings.roofs, 10 * 8, rounding_m2);
}

TEST(SharedFaces, AreFoundInAnyOrderAndInsideOut) {
  std::mt19937 random(5);  // NOLINT(cert-msc51-cpp): the same orders in every run
  for (const auto& boxes : {low_and_high, wing_in_wing, three_heights, wings_and_neighbour}) {
    const Open expected = open_of(own_objects(boxes));
    for (int round = 0; round < 20; ++round) {
      Faces faces = faces_of(boxes);
      std::ranges::shuffle(faces, random);
      // What is least inside is told by the fronts where a third house meets the two.
      if (round % 2 != 0 && boxes != wings_and_neighbour)
        for (auto& face : faces) face = reversed(face);
      const Open open = open_of(one_mesh(faces));
      EXPECT_NEAR(open.walls, expected.walls, rounding_m2) << round;
      EXPECT_NEAR(open.roofs, expected.roofs, rounding_m2) << round;
    }
  }
}

// Whole metres: many have faces in common, whole ones and parts, with one and with several others.
TEST(SharedFaces, OfRandomHeapsShowWhatHousesOfTheirOwnShow) {
  std::mt19937 random(11);  // NOLINT(cert-msc51-cpp): the same boxes in every run
  std::uniform_int_distribution<int> at(0, 2), size(1, 3);
  std::size_t parted = 0;
  for (int round = 0; round < 60; ++round) {
    std::vector<Corners> boxes;
    for (int k = 0; k < 5; ++k) {
      const Vec3 a{1.0 * at(random), 1.0 * at(random), 0};
      boxes.emplace_back(a, a + Vec3{1.0 * size(random), 1.0 * size(random), 1.0 * size(random)});
    }
    const PreparedMesh p = one_mesh(faces_of(boxes));
    parted += p.report.bodies_parted;
    const Open open = open_of(p), expected = open_of(own_objects(boxes));
    EXPECT_NEAR(open.walls, expected.walls, rounding_m2) << round;
    EXPECT_NEAR(open.roofs, expected.roofs, rounding_m2) << round;
  }
  EXPECT_GT(parted, 5u);
}

// An exporter's second copy of a face, of all faces of one house or of all.
TEST(SharedFaces, AreNoneThatAFileHasTwice) {
  const std::vector<Corners> row{{{0, 0, 0}, {4, 8, 6}}, {{4, 0, 0}, {9, 8, 6}}};
  const Faces once = faces_of(row);
  const Open expected = open_of(one_mesh(once));
  for (const auto& [begin, end] : std::vector<std::array<std::size_t, 2>>{
           {0, 1}, {1, 2}, {2, 3}, {4, 5}, {5, 6}, {10, 11}, {3, 9}, {0, 6}, {6, 12}, {0, 12}}) {
    Faces faces = once;
    for (std::size_t f = begin; f < end; ++f) faces.push_back(once[f]);
    const PreparedMesh p = one_mesh(faces);
    EXPECT_EQ(p.report.bodies_parted, 0u) << begin;
    EXPECT_EQ(p.report.closed_bodies, 1u) << begin;
    EXPECT_EQ(p.report.duplicates_dropped, 2 * (end - begin) + 2) << begin;  // and the party wall
    const Open open = open_of(p);
    EXPECT_NEAR(open.walls, expected.walls, rounding_m2) << begin;
    EXPECT_NEAR(open.roofs, expected.roofs, rounding_m2) << begin;
  }
}

// The slab closes the lower storey; without it the upper one would be open.
TEST(SharedFaces, AreNoSlabsBetweenStoreysThatAFileHasTwice) {
  Faces faces = faces_of({{{0, 0, 0}, {8, 6, 3}}, {{0, 0, 3}, {8, 6, 6}}});
  faces[6] = faces[1];
  const PreparedMesh p = one_mesh(faces);
  EXPECT_EQ(p.report.bodies_parted, 0u);
  EXPECT_EQ(p.report.closed_bodies, 1u);
  EXPECT_EQ(p.report.duplicates_dropped, 2u);
  EXPECT_NEAR(p.report.volume_m3, 8 * 6 * 6, rounding_m2);
}

}  // namespace
}  // namespace sunload::test
