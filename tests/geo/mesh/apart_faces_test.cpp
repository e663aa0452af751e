// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Faces between the cells of divided bodies.
#include "geo/mesh/apart_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
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

TEST(ApartFaces, AreSlabsBetweenStoreys) {
  const PreparedMesh p = house_of(storeys(3)).prepared();
  EXPECT_EQ(std::ranges::count(apart_faces(p.mesh).inner, 1), 4);  // two slabs of two triangles
  EXPECT_EQ(p.report.closed_bodies, 1u);
  EXPECT_NEAR(p.report.volume_m3, 3 * 3 * floor_m2, house_rounding_m2);
  const Areas areas = areas_of(house_of(storeys(3)));
  EXPECT_NEAR(areas.open, 3 * walls_of_storey_m2 + 2 * floor_m2, house_rounding_m2);
  EXPECT_NEAR(areas.covered, 2 * floor_m2, house_rounding_m2);
}

TEST(ApartFaces, AreFoundHoweverFacesAreTurned) {
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

TEST(ApartFaces, AreFoundWhereverTheHouseStands) {
  for (const double turn_deg : {0.0, 10.0, 45.0, 133.0}) {
    const double c = std::cos(radians(turn_deg)), s = std::sin(radians(turn_deg));
    auto house = house_of(storeys(3));
    house.moved([&](Vec3 p) { return Vec3{c * p.x - s * p.y + 300, s * p.x + c * p.y, p.z + 7}; });
    EXPECT_NEAR(areas_of(house).covered, 2 * floor_m2, house_rounding_m2) << turn_deg;
  }
}

TEST(ApartFaces, AreThePartOfAPartyWallThatBothHousesHave) {
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

// A longer house stands against the two, with a corner of its walls at their party wall: what lies
// on each other there is parted by the houses that it is of, in whatever order the file has them.
TEST(ApartFaces, AreAPartyWallAtTheCornerOfALongerHouse) {
  std::array<Faces, 3> houses{ModelBuilder::box_faces({4, 1, 0}, {6, 4, 3}),
                              ModelBuilder::box_faces({6, 1, 0}, {8, 3, 3}),
                              ModelBuilder::box_faces({6, 0, 0}, {8, 1, 3})};
  std::array<std::size_t, 3> order{0, 1, 2};
  do {
    Faces faces;
    for (const std::size_t k : order) {
      faces.insert(faces.end(), houses[k].begin(), houses[k].end());
    }
    for (const double turn_deg : {0.0, 90.0, 133.0, 180.0, 270.0}) {
      const double c = std::cos(radians(turn_deg)), s = std::sin(radians(turn_deg));
      auto model = house_of(faces);
      model.moved([&](Vec3 p) { return Vec3{c * p.x - s * p.y, s * p.x + c * p.y, p.z}; });
      const PreparedMesh p = model.prepared();
      const auto told = testing::Message() << order[0] << order[1] << order[2] << " " << turn_deg;
      EXPECT_EQ(std::ranges::count(apart_faces(p.mesh).inner, 1), 2) << told;
      EXPECT_EQ(p.report.triangles_flipped, 0u) << told;
      EXPECT_EQ(p.report.closed_bodies, 2u) << told;
      EXPECT_EQ(p.report.open_sheets, 0u) << told;
      EXPECT_NEAR(p.report.volume_m3, 36, house_rounding_m2) << told;
      // Walls of 16 m about all of it; of party walls 6 m2 twice (they touch) and 6 m2 once.
      const Areas areas = areas_of(model);
      EXPECT_NEAR(areas.open, 16 * 3 + 2 * 12, house_rounding_m2) << told;
      EXPECT_NEAR(areas.covered, 3 * 6, house_rounding_m2) << told;
    }
  } while (std::ranges::next_permutation(order).found);
}

TEST(ApartFaces, AreNoneWhereLightGetsIn) {
  // A storey without a wall: the slab is a balcony's floor and its ceiling.
  Faces faces = storeys(2);
  faces.pop_back();
  const ApartFaces apart = apart_faces(house_of(faces).prepared().mesh);
  EXPECT_EQ(std::ranges::count(apart.inner, 1), 0);
  // The walls and the roof above the slab, which is the roof of the storey below.
  EXPECT_EQ(std::ranges::count(apart.loose, 1), 2 * 4);
  EXPECT_NEAR(areas_of(house_of(faces)).covered, 0, house_rounding_m2);
}

TEST(ApartFaces, AreNoSheetsThatStandOnABody) {
  // A sign on the middle of a roof, a fin on the edge of a wall.
  Faces faces = ModelBuilder::box_faces({0, 0, 0}, {8, 6, 3});
  faces.push_back({{8, 6, 0}, {10, 6, 0}, {10, 6, 3}, {8, 6, 3}});
  const PreparedMesh p = house_of(faces).prepared();
  const ApartFaces apart = apart_faces(p.mesh);
  EXPECT_EQ(std::ranges::count(apart.inner, 1), 0);
  EXPECT_EQ(std::ranges::count(apart.loose, 1), 2);
  EXPECT_EQ(p.report.closed_bodies, 1u);
  EXPECT_EQ(p.report.open_sheets, 1u);
}

/// A house of 12 x 10 m with a ridge along x at 10 m: its roof goes on beyond walls 6 m high by
/// `eaves_m` as faces of their own (SketchUp cuts them so).
Faces house_with_eaves(bool has_floor, double eaves_m) {
  const auto roof = [](double x, double y) { return Vec3{x, y, 10 - 0.8 * std::abs(y - 5)}; };
  Faces faces{{{0, 0, 0}, {12, 0, 0}, {12, 0, 6}, {0, 0, 6}},
              {{12, 10, 0}, {0, 10, 0}, {0, 10, 6}, {12, 10, 6}},
              {{12, 0, 0}, {12, 10, 0}, {12, 10, 6}, {12, 5, 10}, {12, 0, 6}},
              {{0, 10, 0}, {0, 0, 0}, {0, 0, 6}, {0, 5, 10}, {0, 10, 6}}};
  if (has_floor) faces.push_back({{0, 0, 0}, {0, 10, 0}, {12, 10, 0}, {12, 0, 0}});
  const double e = eaves_m;
  for (const bool is_north : {false, true}) {
    const double wall = is_north ? 10 : 0, edge = is_north ? 10 + e : -e;
    Faces half{{roof(0, wall), roof(12, wall), roof(12, 5), roof(0, 5)},
               {roof(0, edge), roof(12, edge), roof(12, wall), roof(0, wall)},
               {roof(-e, edge), roof(0, edge), roof(0, wall), roof(0, 5), roof(-e, 5)},
               {roof(12, edge), roof(12 + e, edge), roof(12 + e, 5), roof(12, 5), roof(12, wall)}};
    for (const auto& face : half) faces.push_back(is_north ? reversed(face) : face);
  }
  return faces;
}

constexpr double slope_of_roof = 1.2806248474865698;  // hypot(1, 0.8)

TEST(ApartFaces, AreEaves) {
  for (const bool has_floor : {true, false}) {
    const PreparedMesh p = house_of(house_with_eaves(has_floor, 0.6)).prepared();
    EXPECT_EQ(p.report.closed_bodies, has_floor ? 1u : 0u);
    EXPECT_NEAR(p.report.volume_m3, has_floor ? 12 * 10 * 8 : 0, house_rounding_m2);
    // Eaves are roof as what they go on from.
    EXPECT_NEAR(area_of(p, Surface::roof), 13.2 * 11.2 * slope_of_roof, house_rounding_m2);
    EXPECT_NEAR(area_of(p, Surface::wall), 2 * 12 * 6 + 2 * 10 * 8, house_rounding_m2);
    EXPECT_NEAR(area_of(p, Surface::other), has_floor ? 12 * 10 : 0, house_rounding_m2);
    EXPECT_EQ(p.report.triangles_flipped, 0u);
  }
}

TEST(ApartFaces, LookWhereTheHouseLooks) {
  // As the file has them half of the house and all of its eaves look inward or down.
  Faces faces = house_with_eaves(true, 0.6);
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (f < 2 || f > 4) faces[f] = reversed(faces[f]);
  const PreparedMesh p = house_of(faces).prepared();
  EXPECT_NEAR(p.report.volume_m3, 12 * 10 * 8, house_rounding_m2);
  EXPECT_NEAR(area_of(p, Surface::roof), 13.2 * 11.2 * slope_of_roof, house_rounding_m2);
  EXPECT_EQ(p.report.looks_down.objects, 0u);
}

// What a terrain closes below a house is its floor; the rest goes on, and is no roof.
TEST(ApartFaces, AreTerrainAroundAHouse) {
  Faces faces = ModelBuilder::box_faces({0, 0, 0}, {8, 6, 3});
  faces[0] = reversed(faces[0]);  // as the terrain looks, upward
  faces.push_back({{-20, -20, 0}, {28, -20, 0}, {8, 0, 0}, {0, 0, 0}});
  faces.push_back({{28, -20, 0}, {28, 26, 0}, {8, 6, 0}, {8, 0, 0}});
  faces.push_back({{28, 26, 0}, {-20, 26, 0}, {0, 6, 0}, {8, 6, 0}});
  faces.push_back({{-20, 26, 0}, {-20, -20, 0}, {0, 0, 0}, {0, 6, 0}});
  const PreparedMesh p = house_of(faces).prepared();
  EXPECT_EQ(p.report.closed_bodies, 1u);
  EXPECT_NEAR(area_of(p, Surface::roof), 48, house_rounding_m2);
  EXPECT_NEAR(area_of(p, Surface::wall), 84, house_rounding_m2);
}

TEST(ApartFaces, AreNoLand) {
  Faces faces = house_with_eaves(true, 0.6);
  ModelBuilder land;
  land.object("quay", "TINRelief");
  for (const auto& face : faces) land.ring(face);
  EXPECT_EQ(std::ranges::count(apart_faces(land.prepared().mesh).loose, 1), 0);
}

TEST(ApartFaces, AreSeenThroughWhatIsNotOpaque) {
  EXPECT_NEAR(areas_of(house_of(storeys(3)), false).covered, 0, house_rounding_m2);
}

TEST(ApartFaces, AreAskedOfOneObjectAtATime) {
  ModelBuilder model;
  model.object("lower").box({0, 0, 0}, {8, 6, 3});
  model.object("upper").walls_and_roof({0, 0, 3}, {8, 6, 6});
  EXPECT_EQ(std::ranges::count(apart_faces(model.prepared().mesh).inner, 1), 0);
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
