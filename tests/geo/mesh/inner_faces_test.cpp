// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Faces between the cells of divided bodies.
#include "geo/mesh/inner_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geo/base/units.h"
#include "geo/mesh/covered.h"
#include "tests/geo/mesh/mesh_prepare_models.h"

namespace sunload::test {
namespace {

using Faces = std::vector<std::vector<Vec3>>;

/// Storeys of 3 m with slabs between them: walls are drawn storey by storey. 8 x 6 m.
Faces storeys(int count) {
  Faces faces;
  for (int k = 0; k < count; ++k) {
    const auto box = ModelBuilder::box_faces({0, 0, 3.0 * k}, {8, 6, 3.0 * (k + 1)});
    faces.insert(faces.end(), box.begin() + (k > 0 ? 1 : 0), box.end());
  }
  return faces;
}

ModelBuilder house_of(const Faces& faces) {
  ModelBuilder model;
  model.object("house");
  for (const auto& face : faces) model.ring(face);
  return model;
}

/// Area of patches of one preparation, and of what is covered of it [m2].
struct Areas {
  double open = 0, covered = 0;
};
Areas areas_of(const ModelBuilder& model, bool is_opaque = true, const PrepareRules& rules = {}) {
  PreparedMesh p = model.prepared(rules);
  cut_covered(p.mesh, p.bodies, std::vector<std::uint8_t>(p.mesh.triangle_count(), is_opaque));
  Areas areas;
  for (std::size_t t = 0; t < p.mesh.triangle_count(); ++t) {
    (p.mesh.is_covered(t) ? areas.covered : areas.open) += p.mesh.area_m2(t);
  }
  return areas;
}

constexpr double house_rounding_m2 = 1e-6, floor_m2 = 48, walls_of_storey_m2 = 84;

TEST(InnerFaces, AreSlabsBetweenStoreys) {
  const PreparedMesh p = house_of(storeys(3)).prepared();
  EXPECT_EQ(std::ranges::count(inner_faces(p.mesh), 1), 4);  // two slabs of two triangles
  EXPECT_EQ(p.report.closed_bodies, 1u);
  EXPECT_NEAR(p.report.volume_m3, 3 * 3 * floor_m2, house_rounding_m2);
  const Areas areas = areas_of(house_of(storeys(3)));
  EXPECT_NEAR(areas.open, 3 * walls_of_storey_m2 + 2 * floor_m2, house_rounding_m2);
  EXPECT_NEAR(areas.covered, 2 * floor_m2, house_rounding_m2);
}

TEST(InnerFaces, AreFoundHoweverFacesAreTurned) {
  const Faces faces = storeys(2);
  for (unsigned choice = 0; choice < (1u << faces.size()); choice += 37) {
    Faces turned = faces;
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (choice >> f & 1u) turned[f] = reversed(faces[f]);
    const Areas areas = areas_of(house_of(turned));
    EXPECT_NEAR(areas.open, 2 * walls_of_storey_m2 + 2 * floor_m2, house_rounding_m2) << choice;
    EXPECT_NEAR(areas.covered, floor_m2, house_rounding_m2) << choice;
  }
}

TEST(InnerFaces, AreFoundWhereverTheHouseStands) {
  for (const double turn_deg : {0.0, 10.0, 45.0, 133.0}) {
    const double c = std::cos(radians(turn_deg)), s = std::sin(radians(turn_deg));
    auto house = house_of(storeys(3));
    house.moved([&](Vec3 p) { return Vec3{c * p.x - s * p.y + 300, s * p.x + c * p.y, p.z + 7}; });
    EXPECT_NEAR(areas_of(house).covered, 2 * floor_m2, house_rounding_m2) << turn_deg;
  }
}

TEST(InnerFaces, AreThePartOfAPartyWallThatBothHousesHave) {
  // The wall of the higher house is drawn in two parts; the lower house has no wall there.
  auto faces = ModelBuilder::box_faces({0, 0, 0}, {8, 6, 9});
  faces.pop_back();
  faces.push_back({{8, 0, 0}, {8, 6, 0}, {8, 6, 5}, {8, 0, 5}});
  faces.push_back({{8, 0, 5}, {8, 6, 5}, {8, 6, 9}, {8, 0, 9}});
  auto lower = ModelBuilder::box_faces({8, 0, 0}, {14, 6, 5});
  lower.erase(lower.begin() + 4);
  faces.insert(faces.end(), lower.begin(), lower.end());
  // Walls of the higher house go to its eaves without a corner at those of the lower one.
  PrepareRules rules;
  rules.repair = Repair::all;
  const PreparedMesh p = house_of(faces).prepared(rules);
  EXPECT_EQ(p.report.closed_bodies, 1u);
  EXPECT_NEAR(p.report.volume_m3, 8 * 6 * 9 + 6 * 6 * 5, house_rounding_m2);
  EXPECT_NEAR(areas_of(house_of(faces), true, rules).covered, 6 * 5, house_rounding_m2);
}

TEST(InnerFaces, AreNoneWhereLightGetsIn) {
  // A storey without a wall: the slab is a balcony's floor and its ceiling.
  Faces faces = storeys(2);
  faces.pop_back();
  EXPECT_EQ(std::ranges::count(inner_faces(house_of(faces).prepared().mesh), 1), 0);
  EXPECT_NEAR(areas_of(house_of(faces)).covered, 0, house_rounding_m2);
}

TEST(InnerFaces, AreNoSheetsThatStandOnABody) {
  // A sign on the middle of a roof, a fin on the edge of a wall.
  Faces faces = ModelBuilder::box_faces({0, 0, 0}, {8, 6, 3});
  faces.push_back({{8, 6, 0}, {10, 6, 0}, {10, 6, 3}, {8, 6, 3}});
  EXPECT_EQ(std::ranges::count(inner_faces(house_of(faces).prepared().mesh), 1), 0);
}

TEST(InnerFaces, AreSeenThroughWhatIsNotOpaque) {
  EXPECT_NEAR(areas_of(house_of(storeys(3)), false).covered, 0, house_rounding_m2);
}

TEST(InnerFaces, AreAskedOfOneObjectAtATime) {
  ModelBuilder model;
  model.object("lower").box({0, 0, 0}, {8, 6, 3});
  model.object("upper").walls_and_roof({0, 0, 3}, {8, 6, 6});
  EXPECT_EQ(std::ranges::count(inner_faces(model.prepared().mesh), 1), 0);
}

/// A house without a floor on land, `sill_m` above it, with a partition that no edge joins to it.
double covered_walls_m2(double sill_m) {
  ModelBuilder model;
  model.object("land", "TINRelief").with(Surface::ground);
  model.ring({{-30, -30, 0}, {30, -30, 0}, {30, 30, 0}, {-30, 30, 0}});
  model.object("house").with(Surface::other).walls_and_roof({0, 0, sill_m}, {8, 6, sill_m + 5});
  model.ring({{3, 0, sill_m}, {3, 6, sill_m}, {3, 6, sill_m + 5}, {3, 0, sill_m + 5}});
  PreparedMesh p = model.prepared();
  cut_covered(p.mesh, p.bodies, std::vector<std::uint8_t>(p.mesh.triangle_count(), 1));
  double walls = 0;
  for (std::size_t t = 0; t < p.mesh.triangle_count(); ++t)
    if (p.mesh.is_covered(t) && p.mesh.triangle_surface[t] == Surface::wall)
      walls += p.mesh.area_m2(t);
  return walls;
}

TEST(OpenHouses, HideTheirPartitions) {
  EXPECT_NEAR(covered_walls_m2(0), 30, house_rounding_m2);
  EXPECT_NEAR(covered_walls_m2(-0.5), 30 + (2 * 8 + 2 * 6) * 0.5, house_rounding_m2);
  EXPECT_EQ(covered_walls_m2(2), 0);  // light comes from below
}

}  // namespace
}  // namespace sunload::test
