// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "geo/base/units.h"
#include "geo/mesh/covered.h"
#include "tests/geo/mesh/mesh_prepare_models.h"

namespace sunload::test {
namespace {

constexpr double surface_rounding = 1e-10;  // sums of some hundred areas

std::map<std::string, Facade> facades(const PreparedMesh& p) {
  std::map<std::string, Facade> result;
  for (const auto& f : p.mesh.facades) result[f.name] = f;
  return result;
}

/// A wall in y = `y` facing south with window openings, each set back by `depth` with reveals.
void add_wall_with_windows(ModelBuilder& builder, double width, double height, double depth,
                           const std::vector<std::pair<Vec3, Vec3>>& windows) {
  std::vector<std::vector<Vec3>> rings{
      {{0, 0, 0}, {width, 0, 0}, {width, 0, height}, {0, 0, height}}};
  for (const auto& [a, b] : windows) {
    rings.push_back({{a.x, 0, a.z}, {a.x, 0, b.z}, {b.x, 0, b.z}, {b.x, 0, a.z}});
  }
  builder.with(Surface::wall).polygon(rings);
  for (const auto& [a, b] : windows) {
    const double d = depth;
    builder.with(Surface::window)
        .ring({{a.x, d, a.z}, {b.x, d, a.z}, {b.x, d, b.z}, {a.x, d, b.z}});
    builder.with(Surface::wall)
        .ring({{a.x, 0, a.z}, {a.x, d, a.z}, {a.x, d, b.z}, {a.x, 0, b.z}})
        .ring({{b.x, d, a.z}, {b.x, 0, a.z}, {b.x, 0, b.z}, {b.x, d, b.z}});
  }
}

TEST(SurfaceKind, ABoxOnAGroundHasWallsRoofAndFloor) {
  const auto p =
      ModelBuilder().object("box").box({0, 0, 0}, {2, 3, 4}).prepared({.ground = GroundRules{}});
  EXPECT_NEAR(area_of(p, Surface::wall), 2 * (8 + 12), surface_rounding);
  EXPECT_NEAR(area_of(p, Surface::roof), 6, surface_rounding);
  EXPECT_NEAR(area_of(p, Surface::floor), 6, surface_rounding);
  EXPECT_EQ(p.report.floors, 2u);
}

TEST(SurfaceKind, WhatTheReaderSaysStays) {
  auto builder = ModelBuilder().object("box").with(Surface::window).box({0, 0, 0}, {2, 3, 4});
  const auto p = builder.prepared();
  EXPECT_NEAR(area_of(p, Surface::window), 52, surface_rounding);
}

TEST(SurfaceKind, BodiesThatHoverHaveNoFloor) {
  auto builder = ModelBuilder().object("ground");
  builder.ring({{-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}});
  builder.object("stands").box({0, 0, 0}, {2, 2, 4});
  builder.object("sunk").box({10, 0, -0.5}, {12, 2, 4});
  builder.object("hovers").box({20, 0, 0.5}, {22, 2, 4});
  builder.object("stacked").box({0.5, 0.5, 4}, {1.5, 1.5, 5});
  const auto p = builder.prepared();
  std::map<std::string, std::set<Surface>> downward;
  for (std::size_t t = 0; t < p.mesh.triangle_count(); ++t) {
    if (p.mesh.area_vector2(t).z < 0) {
      downward[p.mesh.object_names[p.mesh.triangle_object[t].index()]].insert(
          p.mesh.triangle_surface[t]);
    }
  }
  EXPECT_EQ(downward["stands"], std::set{Surface::floor});
  EXPECT_EQ(downward["sunk"], std::set{Surface::floor});
  EXPECT_EQ(downward["stacked"], std::set{Surface::floor});
  EXPECT_EQ(downward["hovers"], std::set{Surface::other});
}

/// What looks down at the foot of each object of a city.
std::map<std::string, std::set<Surface>> undersides(ModelBuilder& builder) {
  const auto p = builder.city().prepared({.ground = GroundRules{}});
  std::map<std::string, std::set<Surface>> downward;
  for (std::size_t t = 0; t < p.mesh.triangle_count(); ++t)
    if (p.mesh.area_vector2(t).z < 0)
      downward[p.mesh.object_names[p.mesh.triangle_object[t].index()]].insert(
          p.mesh.triangle_surface[t]);
  return downward;
}

TEST(SurfaceKind, WhatHangsInACityHasNoFloor) {
  auto builder = ModelBuilder().object("house", "Building").box({0, 0, 0}, {10, 10, 9});
  builder.object("passage", "BuildingPart").box({10, 0, 4}, {14, 10, 9});
  builder.object("balcony", "BuildingInstallation").box({2, -1.5, 3}, {6, 0, 3.2});
  builder.object("stair", "BuildingInstallation").box({7, -1.5, 0}, {9, 0, 1});
  builder.object("canopy", "BuildingInstallation").box({30, 0, 5}, {40, 8, 5.5});
  builder.object("panel").box({0, 20, 3}, {4, 24, 3.2});
  builder.object("plate").box({-20, -20, -1}, {60, 40, 0});
  builder.object("tower", "BuildingInstallation").box({2, 2, 9}, {5, 5, 14});
  auto found = undersides(builder);
  EXPECT_EQ(found["house"], std::set{Surface::floor});
  EXPECT_EQ(found["stair"], std::set{Surface::floor});
  EXPECT_EQ(found["plate"], std::set{Surface::floor});
  EXPECT_EQ(found["tower"], std::set{Surface::floor});
  EXPECT_EQ(found["passage"], std::set{Surface::other});
  EXPECT_EQ(found["balcony"], std::set{Surface::other});
  EXPECT_EQ(found["canopy"], std::set{Surface::other});
  EXPECT_EQ(found["panel"], std::set{Surface::other});
}

TEST(SurfaceKind, WhereNothingIsBelowTheGroundDecides) {
  auto builder = ModelBuilder().object("low").box({0, 0, 0}, {2, 2, 4});
  builder.object("high").box({20, 0, 1}, {22, 2, 4});
  // Without a ground both are lit from below.
  const auto p = builder.prepared();
  EXPECT_NEAR(area_of(p, Surface::floor), 0, surface_rounding);
  EXPECT_NEAR(area_of(p, Surface::other), 8, surface_rounding);
  const auto on_plate = builder.prepared({.ground = GroundRules{5, GroundSurface::level}});
  EXPECT_NEAR(area_of(on_plate, Surface::floor), 4, surface_rounding);
  EXPECT_NEAR(area_of(on_plate, Surface::other), 4, surface_rounding);
  const auto on_feet = builder.prepared({.ground = GroundRules{5}});
  EXPECT_NEAR(area_of(on_feet, Surface::floor), 8, surface_rounding);
}

TEST(SurfaceKind, AFloorIsWhatTouchesNotWhatLooksDown) {
  auto builder = ModelBuilder().object("table").box({0, 0, 0}, {10, 10, 1});
  builder.object("beyond its edge").box({9, 2, 1}, {12, 4, 2});
  builder.object("near above it").box({2, 2, 1.02}, {4, 4, 2});
  const auto p = builder.prepared();
  EXPECT_EQ(p.report.floors, 0u);  // the first is cut where the table ends
  builder.object("on it").box({6, 6, 1}, {7, 7, 2});
  EXPECT_NEAR(area_of(builder.prepared(), Surface::floor), 1, surface_rounding);
}

TEST(SurfaceKind, OpenSheetsOfPlainFilesOnlyHaveWalls) {
  auto builder = ModelBuilder().object("terrain");
  builder.ring({{0, 0, 0}, {9, 0, 0}, {9, 9, 1}, {0, 9, 1}});
  builder.ring({{0, 9, 1}, {9, 9, 1}, {9, 9, 4}, {0, 9, 4}});
  const auto p = builder.prepared();
  EXPECT_NEAR(area_of(p, Surface::wall), 27, surface_rounding);
  EXPECT_GT(area_of(p, Surface::other), 81);
  EXPECT_EQ(p.report.floors, 0u);
}

TEST(SurfaceKind, HousesWithoutAFloorHaveRoofs) {
  auto builder = ModelBuilder().object("house").walls_and_roof({0, 0, 0}, {8, 6, 3});
  EXPECT_NEAR(area_of(builder.prepared(), Surface::roof), 48, surface_rounding);
  // On a slope, as terrain would have it.
  builder.object("on a slope").moved([](Vec3 p) {
    return p.z > 0 ? p : Vec3{p.x, p.y, -0.2 * p.x};
  });
  EXPECT_NEAR(area_of(builder.prepared(), Surface::roof), 48, surface_rounding);
}

TEST(SurfaceKind, SheetsThatAreOpenElsewhereHaveNone) {
  const auto roof_of = [](const std::vector<std::vector<Vec3>>& faces) {
    auto builder = ModelBuilder().object("sheet");
    for (const auto& face : faces) builder.ring(face);
    return area_of(builder.prepared(), Surface::roof);
  };
  auto faces = ModelBuilder::box_faces({0, 0, 0}, {8, 6, 3});
  faces.erase(faces.begin());
  EXPECT_NEAR(roof_of(faces), 48, surface_rounding);
  auto without_wall = faces;
  without_wall.pop_back();
  EXPECT_EQ(roof_of(without_wall), 0);
  auto inward = faces;
  for (auto& face : inward) face = reversed(face);
  EXPECT_EQ(roof_of(inward), 0);
}

TEST(SurfaceKind, CitiesKnowLandAndPlants) {
  auto builder = ModelBuilder().city().object("road", "Road");
  builder.ring({{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}});
  builder.object("tree", "SolitaryVegetationObject").box({20, 0, 2}, {22, 2, 4});
  builder.object("house", "Building");
  auto faces = ModelBuilder::box_faces({30, 0, 1}, {32, 2, 4});
  for (std::size_t f = 0; f < 5; ++f) builder.ring(faces[f]);  // one wall is missing
  const auto p = builder.prepared();
  EXPECT_NEAR(area_of(p, Surface::ground), 81, surface_rounding);
  EXPECT_NEAR(area_of(p, Surface::other), 24, surface_rounding);
  EXPECT_NEAR(area_of(p, Surface::floor), 4, surface_rounding);
  EXPECT_NEAR(area_of(p, Surface::wall), 18, surface_rounding);
  EXPECT_EQ(p.mesh.facades.size(), 3u);
}

TEST(Facade, ABoxHasFour) {
  const auto p = ModelBuilder().object("house_3").box({0, 0, 0}, {2, 3, 4}).prepared();
  const auto f = facades(p);
  ASSERT_EQ(f.size(), 4u);
  EXPECT_NEAR(f.at("house_3/north_1").area_m2, 8, surface_rounding);
  EXPECT_NEAR(f.at("house_3/north_1").azimuth_deg, 0, surface_rounding);
  EXPECT_NEAR(f.at("house_3/east_1").area_m2, 12, surface_rounding);
  EXPECT_NEAR(f.at("house_3/east_1").azimuth_deg, 90, surface_rounding);
  EXPECT_NEAR(f.at("house_3/south_1").azimuth_deg, 180, surface_rounding);
  EXPECT_NEAR(f.at("house_3/west_1").azimuth_deg, 270, surface_rounding);
  EXPECT_EQ(p.mesh.facades[0].name, "house_3/north_1");
  EXPECT_EQ(p.mesh.facades[3].name, "house_3/west_1");
}

TEST(Facade, NamesFollowTrueNorthAndAzimuthsTheScene) {
  auto builder = ModelBuilder().object("h").box({0, 0, 0}, {2, 3, 4});
  const auto p = builder.prepared({.repair = Repair::safe, .ground = {}, .north_deg = 90});
  const auto f = facades(p);
  EXPECT_NEAR(f.at("h/east_1").azimuth_deg, 0, surface_rounding);
  EXPECT_NEAR(f.at("h/east_1").area_m2, 8, surface_rounding);
}

/// Of a star of houses, one of them against another: what is covered loses its facade.
TEST(Facade, TurnedTheyAreThoseFoundWithThatNorth) {
  auto builder = ModelBuilder().object("star");
  for (int i = 0; i < 9; ++i) builder.box({3.0 * i, 0, 0}, {3.0 * i + 2, 1.0 + i % 3, 4});
  builder.moved([](Vec3 p) { return Vec3{p.x * std::cos(p.x / 9), p.y + p.x * p.x / 30, p.z}; });
  builder.object("left").box({-9, 0, 0}, {-6, 3, 4});
  builder.object("glued").box({-6, 0, 0}, {-3, 3, 4});
  const auto with_north = [&](double north_deg) {
    auto p = builder.prepared({.repair = Repair::safe, .ground = {}, .north_deg = north_deg});
    const std::vector<std::uint8_t> is_opaque(p.mesh.triangle_count(), 1);
    cut_covered(p.mesh, p.bodies, is_opaque);
    return p;
  };
  auto turned = with_north(0);
  ASSERT_LT(turned.mesh.facades.size(), turned.facades.size());
  std::set<std::string> orders;
  for (const double north_deg : {33.0, 200.0, -71.5, 359.0, 0.0, 90.0}) {
    turn_facades(turned.mesh, turned.facades, north_deg);
    const auto found = with_north(north_deg);
    ASSERT_EQ(turned.mesh.facades.size(), found.mesh.facades.size());
    std::string order;
    for (std::size_t f = 0; f < found.mesh.facades.size(); ++f) {
      EXPECT_EQ(turned.mesh.facades[f].name, found.mesh.facades[f].name);
      EXPECT_EQ(turned.mesh.facades[f].area_m2, found.mesh.facades[f].area_m2);
      EXPECT_EQ(turned.mesh.facades[f].azimuth_deg, found.mesh.facades[f].azimuth_deg);
      order += found.mesh.facades[f].name + " ";
    }
    EXPECT_EQ(turned.mesh.triangle_facade, found.mesh.triangle_facade);
    orders.insert(order);
  }
  EXPECT_GT(orders.size(), 3u);
}

TEST(Facade, RecessedWindowsBelongToTheirWallAndRevealsDoNot) {
  auto builder = ModelBuilder().object("house");
  std::vector<std::pair<Vec3, Vec3>> windows;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Vec3 a{1.0 + 4 * i, 0, 1.0 + 3 * j};
      windows.emplace_back(a, a + Vec3{1.5, 0, 1.5});
    }
  }
  add_wall_with_windows(builder, 20, 10, 0.2, windows);
  const auto p = builder.prepared();
  ASSERT_EQ(p.mesh.facades.size(), 1u);
  EXPECT_EQ(p.mesh.facades[0].name, "house/south_1");
  EXPECT_NEAR(p.mesh.facades[0].area_m2, 200,
              surface_rounding);  // openings are filled by the windows
  for (std::size_t t = 0; t < p.mesh.triangle_count(); ++t) {
    const bool is_reveal = std::abs(p.mesh.area_vector2(t).x) > 0;
    EXPECT_EQ(p.mesh.triangle_facade[t].exists(), !is_reveal);
    if (p.mesh.triangle_surface[t] == Surface::window) {
      EXPECT_TRUE(p.mesh.triangle_facade[t].exists());
    }
  }
}

TEST(Facade, WingsApartAreNumberedByArea) {
  auto builder = ModelBuilder().object("school");
  builder.box({0, 0, 0}, {5, 4, 3}).box({10, 0, 0}, {18, 4, 3});
  builder.box({30, 0, 0}, {36, 4, 3}).box({36.5, 0, 0}, {42, 4, 3});  // a gap of 0.5 m
  const auto f = facades(builder.prepared());
  EXPECT_NEAR(f.at("school/south_1").area_m2, 34.5, surface_rounding);
  EXPECT_NEAR(f.at("school/south_2").area_m2, 24, surface_rounding);
  EXPECT_NEAR(f.at("school/south_3").area_m2, 15, surface_rounding);
  EXPECT_EQ(f.count("school/south_4"), 0u);
}

TEST(Facade, ARoundTowerFallsIntoSectors) {
  auto builder = ModelBuilder().object("tower").with(Surface::wall);
  const int n = 72;
  for (int i = 0; i < n; ++i) {
    const auto at = [&](int k, double z) {
      return Vec3{5 * std::cos(2 * pi * k / n), 5 * std::sin(2 * pi * k / n), z};
    };
    builder.ring({at(i, 0), at(i + 1, 0), at(i + 1, 8), at(i, 8)});
  }
  const auto p = builder.prepared();
  EXPECT_GE(p.mesh.facades.size(), 360u / 30u);
  EXPECT_LE(p.mesh.facades.size(), 24u);
  double sum = 0;
  for (const auto& f : p.mesh.facades) sum += f.area_m2;
  EXPECT_NEAR(sum, area(p.mesh), 1e-9);
}

TEST(Facade, AreasAndOrderDoNotDependOnTheOrderOfTheFile) {
  auto faces = ModelBuilder::box_faces({0, 0, 0}, {2, 3, 4});
  const auto more = ModelBuilder::box_faces({9, 0, 0}, {11, 3, 4});
  faces.insert(faces.end(), more.begin(), more.end());
  std::vector<std::vector<Facade>> results;
  for (const bool is_reversed : {false, true}) {
    if (is_reversed) std::reverse(faces.begin(), faces.end());
    auto builder = ModelBuilder().object("h");
    for (const auto& face : faces) builder.ring(face);
    results.push_back(builder.prepared().mesh.facades);
  }
  ASSERT_EQ(results[0].size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(results[0][i].name, results[1][i].name);
    EXPECT_NEAR(results[0][i].area_m2, results[1][i].area_m2, surface_rounding);
  }
}

TEST(Facade, SliversMakeNone) {
  const auto p = ModelBuilder().object("kerb").box({0, 0, 0}, {50, 0.1, 0.015}).prepared();
  EXPECT_TRUE(p.mesh.facades.empty());
}

}  // namespace
}  // namespace sunload::test
