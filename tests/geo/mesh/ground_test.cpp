// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A ground through the feet of bodies, or level.
#include "geo/mesh/ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geo/base/check.h"
#include "geo/mesh/covered.h"
#include "geo/mesh/land.h"
#include "geo/mesh/slope.h"
#include "tests/geo/mesh/mesh_prepare_models.h"

namespace sunload::test {
namespace {

constexpr double ground_rounding = 1e-9;

PrepareRules on_feet(double margin_m = 20) { return {.ground = GroundRules{margin_m}}; }

/// Heights of all ground above a point in plan, made or of the model.
std::vector<double> ground_at(const Mesh& mesh, double x, double y) {
  std::vector<double> heights;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.triangle_surface[t] != Surface::ground) continue;
    if (const auto z = height_at(mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2), x, y))
      heights.push_back(*z);
  }
  return heights;
}

double plan_area(const Mesh& mesh, bool is_covered) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.triangle_surface[t] == Surface::ground && mesh.is_covered(t) == is_covered)
      sum += std::abs(mesh.area_vector2(t).z) / 2;
  return sum;
}

/// Above any foot within the object's bounding box by no more than this, and never below one.
void expect_on_ground(const PreparedMesh& p, double tolerance) {
  ASSERT_TRUE(p.report.ground);
  for (const auto& gap : p.report.ground->worst)
    EXPECT_LE(gap.gap_m, tolerance) << gap.object << " floats";
}

// Of plain files a canopy over the terrain is none of the walls that are drawn down to it.
TEST(Ground, CanopiesOfPlainFilesHover) {
  ModelBuilder builder;
  builder.object("terrain", "TINRelief");
  builder.ring({{-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}});
  builder.object("canopy").box({0, 0, 3}, {10, 10, 3.3});
  builder.object("house").box({20, 0, 1}, {30, 10, 7});
  const auto made = builder.prepared({.ground = GroundRules{30}});
  double low_of_canopy = 1e9, low_of_house = 1e9;
  for (std::size_t t = 0; t < made.mesh.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k) {
      const double z = made.mesh.corner(t, k).z + made.mesh.origin.z;
      const auto& name = made.mesh.object_names[made.mesh.triangle_object[t].index()];
      if (name == "canopy") low_of_canopy = std::min(low_of_canopy, z);
      if (name == "house") low_of_house = std::min(low_of_house, z);
    }
  EXPECT_EQ(low_of_canopy, 3);
  EXPECT_LT(low_of_house, 0);
  ASSERT_EQ(made.report.ground->drawn_far.size(), 1u);  // a sign could be a metre above it
  EXPECT_EQ(made.report.ground->drawn_far[0].object, "house");
  EXPECT_EQ(made.report.ground->drawn_far[0].gap_m, 1);
}

TEST(Ground, LevelFeetGetAPlateWithoutWhatLiesUnderThem) {
  auto builder = ModelBuilder().object("a").box({0, 0, 2}, {10, 20, 5});
  builder.object("b").box({15, 0, 2}, {18, 3, 9});
  const auto p = builder.prepared(on_feet(5));
  EXPECT_TRUE(p.report.ground->is_level);
  EXPECT_EQ(p.report.ground->standing, 2u);
  EXPECT_EQ(p.report.ground->low_m, 2);
  EXPECT_EQ(p.report.ground->high_m, 2);
  EXPECT_NEAR(plan_area(p.mesh, false) + plan_area(p.mesh, true), 28 * 30, ground_rounding * 1000);
  EXPECT_NEAR(plan_area(p.mesh, true), 200 + 9, ground_rounding * 1000);
  EXPECT_NEAR(p.report.covered_m2[static_cast<std::size_t>(Surface::ground)], 209, 1e-6);
  EXPECT_NEAR(area_of(p, Surface::floor), 209, 1e-6);
}

TEST(Ground, GoesThroughFeetOfAllHeights) {
  auto builder = ModelBuilder();
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j) {
      const double z = 0.3 * i + 0.7 * ((i * 3 + j * 2) % 5);
      builder.object("house_" + std::to_string(5 * i + j))
          .box({20.0 * i, 20.0 * j, z}, {20.0 * i + 9, 20.0 * j + 11, z + 8});
    }
  const auto p = builder.prepared(on_feet());
  EXPECT_FALSE(p.report.ground->is_level);
  EXPECT_EQ(p.report.ground->standing, 25u);
  EXPECT_EQ(p.report.ground->hovering.size(), 0u);
  EXPECT_NEAR(p.report.ground->gap_m.front(), 0, ground_rounding);
  EXPECT_NEAR(p.report.ground->gap_m.back(), 0, ground_rounding);
  EXPECT_NEAR(plan_area(p.mesh, true), 25 * 99, 1e-6);
  EXPECT_NEAR(plan_area(p.mesh, false), 129 * 131 - 25 * 99, 1e-6);
  // By another way: the height beside each wall.
  for (std::size_t t = 0; t < p.mesh.triangle_count(); ++t) {
    if (p.mesh.triangle_surface[t] != Surface::floor) continue;
    for (int k = 0; k < 3; ++k) {
      const Vec3 v = p.mesh.corner(t, k);
      const auto heights = ground_at(p.mesh, v.x, v.y);
      ASSERT_FALSE(heights.empty());
      for (const double z : heights) EXPECT_NEAR(z, v.z, ground_rounding);
    }
  }
}

// A design in a plain file stands in a city as its buildings do.
TEST(Ground, GoesThroughFeetOfObjectsWithoutATypeInACity) {
  auto builder = ModelBuilder().city();
  for (int i = 0; i < 4; ++i)
    builder.object("house_" + std::to_string(i), "Building")
        .box({30.0 * i, 0, 10}, {30.0 * i + 10, 10, 18});
  builder.object("design").box({60, 30, 16}, {70, 40, 24});
  builder.object("canopy").box({0, -20, 14}, {5, -15, 14.2});
  builder.object("tree", "SolitaryVegetationObject").box({90, 30, 12}, {92, 32, 20});
  const auto p = builder.prepared(on_feet());
  EXPECT_EQ(p.report.ground->standing, 5u);
  EXPECT_NEAR(p.report.ground->gap_m.front(), 0, ground_rounding);
  EXPECT_NEAR(p.report.ground->gap_m.back(), 0, ground_rounding);
  EXPECT_NEAR(plan_area(p.mesh, true), 500, 1e-6);
}

TEST(Ground, IsLevelBeyondTheOutermostFeet) {
  auto builder = ModelBuilder().object("low").box({0, 0, 0}, {10, 10, 5});
  builder.object("high").box({40, 0, 3}, {50, 10, 9});
  const auto p = builder.prepared(on_feet());
  for (const double z : ground_at(p.mesh, -15, 5)) EXPECT_NEAR(z, 0, ground_rounding);
  for (const double z : ground_at(p.mesh, 65, 5)) EXPECT_NEAR(z, 3, ground_rounding);
  for (const double z : ground_at(p.mesh, 25, 5)) EXPECT_NEAR(z, 1.5, 0.01);
}

TEST(Ground, OfSlopingFeetIsTheSlope) {
  auto builder = ModelBuilder();
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      builder.object("house_" + std::to_string(4 * i + j))
          .box({20.0 * i, 20.0 * j, 0}, {20.0 * i + 9, 20.0 * j + 11, 8});
  builder.moved([](Vec3 v) { return Vec3{v.x, v.y, v.z + 0.15 * v.x - 0.08 * v.y}; });
  const auto p = builder.prepared(on_feet());
  EXPECT_EQ(p.report.ground->standing, 16u);
  EXPECT_NEAR(p.report.ground->gap_m.back(), 0, ground_rounding);
  EXPECT_NEAR(p.report.ground->gap_m.front(), 0, ground_rounding);
  // Beside the houses, between them, and to the margin's rim.
  for (const auto& [x, y] : {std::pair{15.0, 15.0},
                             {33.0, 50.0},
                             {62.0, 3.0},
                             {-19.9, -19.9},
                             {30.0, -19.0},
                             {88.9, 90.9},
                             {80.0, 30.0},
                             {-12.0, 85.0}}) {
    const auto heights = ground_at(p.mesh, x, y);
    EXPECT_EQ(heights.size(), 1u);
    for (const double z : heights) EXPECT_NEAR(z, 0.15 * x - 0.08 * y, ground_rounding);
  }
  EXPECT_NEAR(p.report.ground->steepest_beyond, 0.17, 1e-6);
}

TEST(Ground, GoesOnByASlopeNoFartherThanFeetTellIt) {
  auto builder = ModelBuilder();
  for (int i = 0; i < 4; ++i)
    builder.object("house_" + std::to_string(i)).box({20.0 * i, 0, 0}, {20.0 * i + 9, 11, 8});
  builder.moved([](Vec3 v) { return Vec3{v.x, v.y, v.z + 0.1 * v.x}; });
  const auto p = builder.prepared(on_feet(3000));
  const double reach = std::hypot(69.0, 11.0);
  for (const double z : ground_at(p.mesh, 69 + reach - 1, 5))
    EXPECT_NEAR(z, 0.1 * (69 + reach - 1), 0.05);
  for (const double z : ground_at(p.mesh, 3000, 5)) EXPECT_NEAR(z, 0.1 * (69 + reach), 0.05);
}

TEST(Ground, FeetNowHigherNowLowerTellNoSlope) {
  auto builder = ModelBuilder();
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      const double z = std::fmod(0.618 * i + 0.755 * j, 1.0);
      builder.object("house_" + std::to_string(6 * i + j))
          .box({20.0 * i, 20.0 * j, z}, {20.0 * i + 9, 20.0 * j + 11, z + 8});
    }
  const auto p = builder.prepared(on_feet());
  EXPECT_LT(p.report.ground->steepest_beyond, 1e-3);
}

TEST(Ground, AStepBetweenTwoHousesHidesTheLowerFoot) {
  auto builder = ModelBuilder().object("low").box({0, 0, 0}, {10, 10, 9});
  builder.object("high").box({10.0004, 0.0003, 1.5}, {20, 10, 12});  // a party wall, as written
  const auto p = builder.prepared(on_feet());
  EXPECT_EQ(p.report.ground->standing, 2u);
  EXPECT_LE(p.report.ground->gap_m.back(), 0.001);
  EXPECT_NEAR(p.report.ground->gap_m.front(), -1.5, land_snap_m);
  EXPECT_EQ(p.report.ground->worst.front().object, "low");
}

TEST(Ground, BodiesOnBodiesBaysAndBalconiesAreNoFeet) {
  auto builder = ModelBuilder().city().object("house", "Building");
  builder.box({0, 0, 0}, {10, 10, 9});     // stands
  builder.box({2, 2, 9}, {4, 4, 11});      // a chimney on it
  builder.box({3, -1.2, 5}, {6, 0, 5.2});  // a balcony
  builder.object("tree", "SolitaryVegetationObject").box({20, 0, 3}, {24, 4, 8});
  builder.object("bridge", "Bridge").box({30, 0, 6}, {50, 4, 7});
  builder.object("barn", "Building").box({60, 0, 1}, {70, 4, 7});
  const auto p = builder.prepared(on_feet());
  EXPECT_EQ(p.report.ground->standing, 2u);
  EXPECT_EQ(p.report.ground->on_others, 1u);
  ASSERT_EQ(p.report.ground->hovering.size(), 1u);
  EXPECT_EQ(p.report.ground->hovering[0].object, "house");
  EXPECT_NEAR(p.report.ground->hovering[0].gap_m, 5, 0.05);
  EXPECT_EQ(p.report.ground->high_m, 1);
  EXPECT_NEAR(p.report.ground->gap_m.back(), 0, ground_rounding);
}

/// Open undersides at a height.
double underside(const Mesh& mesh, double z) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    if (slope_of(mesh, t) == Slope::downward && mesh.bears_patches(t) &&
        std::abs(mesh.corner(t, 0).z + mesh.origin.z - z) < 1e-3)
      sum += mesh.area_m2(t);
  return sum;
}

/// A slab on a core, columns under a corner, a house that juts out over a lower one: most of the
/// foot is free, and land that climbed to it would bury what carries it.
TEST(Ground, WhatRestsOnALowerBodyInPartStandsOnIt) {
  struct Carrier {
    Vec3 low, high;
  };
  for (const Carrier& carrier :
       {Carrier{{6, 3, 0}, {10, 7, 4}}, Carrier{{0, 0, 0}, {7, 10, 4}},
        Carrier{{1, -1.4, 0}, {12, 7, 4}}, Carrier{{15, 9, 0}, {16, 10, 4}}})
    for (const bool has_land : {false, true}) {
      auto builder = ModelBuilder().city().object("high", "Building");
      builder.box({0, 0, 4}, {16, 10, 14});
      builder.object("low", "Building").box(carrier.low, carrier.high);
      builder.object("west", "Building").box({-20, 0, 0}, {-8, 10, 8});
      builder.object("east", "Building").box({24, 0, 0}, {34, 10, 8});
      if (has_land)
        builder.object("land", "LandUse")
            .ring({{-60, -60, 0}, {60, -60, 0}, {60, 60, 0}, {-60, 60, 0}});
      const auto p = builder.prepared(on_feet());
      const GroundReport& ground = *p.report.ground;
      EXPECT_EQ(ground.on_others, 1u) << carrier.low.x;
      EXPECT_EQ(ground.standing, 3u) << carrier.low.x;
      EXPECT_EQ(ground.hovering.size(), 0u) << carrier.low.x;
      EXPECT_EQ(ground.drawn, 0u) << carrier.low.x;
      for (const double z : ground_at(p.mesh, 8, -2)) EXPECT_NEAR(z, 0, ground_rounding);
      EXPECT_NEAR(underside(p.mesh, 4), 160, 1e-6);  // what touches is cut out later
    }
}

/// The other way round: a garage dug into the slope below a house, whose neighbours stand as high,
/// or the land does.
TEST(Ground, AHouseOverAGarageInTheSlopeStandsOnTheLand) {
  for (const bool has_land : {false, true}) {
    auto builder = ModelBuilder().city().object("house", "Building");
    builder.box({0, 0, 3}, {16, 10, 12});
    builder.object("garage", "Building").box({4, -2, 0}, {8, 6, 3});
    builder.object("west", "Building").box({-20, 0, 3}, {-8, 10, 8});
    builder.object("east", "Building").box({24, 0, 3}, {34, 10, 8});
    if (has_land)
      builder.object("land", "LandUse")
          .ring({{-60, -2, 2.5}, {60, -2, 2.5}, {60, 60, 3}, {-60, 60, 3}});
    const auto p = builder.prepared(on_feet());
    EXPECT_EQ(p.report.ground->on_others, 0u) << has_land;
    if (has_land) continue;
    for (const double z : ground_at(p.mesh, 14, -0.5)) EXPECT_GT(z, 2) << z;
  }
}

/// A deck may be thinner than any step: what carries it is asked. A roof upon walls without a
/// ceiling touches none, and buries nothing.
TEST(Ground, DecksCarryAndRoofsHover) {
  auto deck = ModelBuilder().city().object("house", "Building");
  deck.box({0, 0, 3.2}, {12, 8, 9});
  deck.object("deck", "Building").box({-6, -8, 3}, {14, 3, 3.2});
  for (const double x : {-5.0, 13.0})
    for (const double y : {-7.0, 2.0})
      deck.object("column", "Building").box({x, y, 0}, {x + 0.4, y + 0.4, 3});
  deck.object("neighbour", "Building").box({30, 0, 0}, {40, 10, 6});
  const auto on_deck = deck.prepared(on_feet());
  EXPECT_EQ(on_deck.report.ground->on_others, 2u);
  EXPECT_EQ(on_deck.report.ground->high_m, 0);

  auto open = ModelBuilder().city().object("walls", "Building");
  open.ring({{0, 0, 0}, {12, 0, 0}, {12, 0, 6}, {0, 0, 6}});
  open.ring({{12, 0, 0}, {12, 8, 0}, {12, 8, 6}, {12, 0, 6}});
  open.ring({{12, 8, 0}, {0, 8, 0}, {0, 8, 6}, {12, 8, 6}});
  open.ring({{0, 8, 0}, {0, 0, 0}, {0, 0, 6}, {0, 8, 6}});
  open.ring({{0, 0, 0}, {0, 8, 0}, {12, 8, 0}, {12, 0, 0}});
  open.object("roof", "Building").box({-1, -1, 6}, {13, 9, 6.3});
  const auto roofed = open.prepared(on_feet());
  EXPECT_EQ(roofed.report.ground->high_m, 0);
}

/// Nothing about tells where the land is: a body stands where it would not fall, and not on what
/// looks like a cellar.
TEST(Ground, ALoneHouseStandsOnTheLandAboveItsCellar) {
  const auto highest = [](Vec3 low, Vec3 high) {
    auto builder = ModelBuilder().city().object("house", "Building");
    builder.box({0, 0, 0}, {12, 10, 9});
    builder.object("lower", "Building").box(low, high);
    const auto p = builder.prepared(on_feet());
    double z = -infinity;
    for (const double ground : ground_at(p.mesh, 6, -8)) z = std::max(z, ground);
    return z;
  };
  EXPECT_EQ(highest({3, 2, -3}, {9, 8, 0}), 0) << "a cellar";
  EXPECT_EQ(highest({1, -4, -3}, {5, 3, 0}), 0) << "a garage dug in before it";
  EXPECT_EQ(highest({5, 4, -3}, {7, 6, 0}), -3) << "a core";
  EXPECT_EQ(highest({0, 0, -3}, {6, 10, 0}), -3) << "a house that it juts out over";
}

/// One neighbour is enough to tell that, and so is a row of houses with garages of their own; a
/// roof that reaches under a house by the inexactness of outlines carries nothing.
TEST(Ground, HousesWithGaragesInTheSlopeTellOfTheLandTogether) {
  for (const double under_m : {0.1, 3.0})
    for (const int houses : {1, 6}) {
      auto builder = ModelBuilder().city();
      for (int k = 0; k < houses; ++k) {
        const double x = 20.0 * k;
        const auto name = [&](const char* of) { return of + std::to_string(k); };
        builder.object(name("house_"), "Building").box({x, 0, 3}, {x + 12, 10, 12});
        builder.object(name("garage_"), "Building").box({x + 1, -5, 0}, {x + 5, under_m, 3});
      }
      if (houses == 1) builder.object("neighbour", "Building").box({20, 0, 3}, {30, 10, 9});
      const auto p = builder.prepared(on_feet());
      EXPECT_EQ(p.report.ground->on_others, 0u) << under_m << " " << houses;
      for (const double z : ground_at(p.mesh, 16, 5)) EXPECT_NEAR(z, 3, 1e-6);
    }
}

/// Panes of a plain file, before a wall or set back into it: land would climb to their sills.
TEST(Ground, PanesOnWallsHaveNoFeet) {
  for (const double before : {0.0, 0.03, -0.2}) {
    auto builder = ModelBuilder().object("house").box({0, 0, 0}, {10, 8, 6}).object("glazing");
    for (const double x : {1.0, 4.0, 7.0})
      for (const double z : {0.9, 3.9})
        builder.ring({{x, -before, z},
                      {x + 2, -before, z},
                      {x + 2, -before, z + 1.5},
                      {x, -before, z + 1.5}});
    const auto p = builder.prepared(on_feet());
    ASSERT_TRUE(p.report.ground);
    EXPECT_EQ(p.report.ground->standing, 1u) << before;
    for (const double z : ground_at(p.mesh, 2, -0.1)) EXPECT_NEAR(z, 0, ground_rounding) << before;
  }
}

/// A garden wall that begins at a house stands on its own feet, up a slope, too.
TEST(Ground, SheetsThatStandBesideAHouseHaveFeet) {
  auto builder = ModelBuilder().object("house").box({0, 0, 0}, {10, 8, 6}).object("garden");
  builder.ring({{10, 4, 0}, {20, 4, 1.5}, {20, 4, 3}, {10, 4, 2}});
  const auto p = builder.prepared(on_feet());
  ASSERT_TRUE(p.report.ground);
  EXPECT_EQ(p.report.ground->standing, 2u);
  const auto at_end = ground_at(p.mesh, 19.9, 4.01);
  ASSERT_FALSE(at_end.empty());
  EXPECT_NEAR(at_end.front(), 1.485, 0.02);
}

TEST(Ground, HousesWithoutFloorsCoverTheGround) {
  auto builder = ModelBuilder().city().object("house", "Building");
  const auto faces = ModelBuilder::box_faces({0, 0, 1}, {10, 10, 9});
  for (std::size_t f = 1; f < faces.size(); ++f) builder.ring(faces[f]);
  builder.object("other", "Building").box({30, 0, 0}, {40, 10, 9});
  const auto p = builder.prepared(on_feet());
  EXPECT_EQ(p.report.ground->standing, 2u);
  EXPECT_NEAR(plan_area(p.mesh, true), 200, 1e-6);
}

// Terraces are often written without party walls, and neighbours of what is taken away have none.
TEST(Ground, FloorsWhoseWallsAreMissingCoverWhatLiesUnderThemAlone) {
  const auto faces = ModelBuilder::box_faces({0, 0, 0}, {20, 10, 6});  // two level ones, four walls
  for (const double slope : {0.0, 0.1})
    for (unsigned missing = 0; missing < 15; ++missing) {
      auto builder = ModelBuilder().object("house");
      for (std::size_t k = 0; k < faces.size(); ++k)
        if (k < 2 || (missing >> (k - 2) & 1) == 0) builder.ring(faces[k]);
      builder.moved([&](Vec3 p) { return Vec3{p.x, p.y, p.z + slope * p.x}; });
      const auto p = builder.prepared(on_feet(10));
      EXPECT_NEAR(plan_area(p.mesh, true), 200, 1e-6)
          << "slope " << slope << " without " << missing;
      EXPECT_NEAR(plan_area(p.mesh, false), 40 * 30 - 200, 1e-6);
    }
}

// A square that the model has as an object covers the land that lies on it, and no more.
TEST(Ground, BesideSquaresOfTheModelTheLandIsOpen) {
  auto builder = ModelBuilder().object("a").box({0, 0, 0}, {10, 10, 6});
  builder.object("b").box({40, 0, 0}, {50, 10, 6});
  builder.object("square").with(Surface::other);
  builder.ring({{18, 2, 0}, {33, 1, 0}, {30, 9, 0}, {19, 8, 0}});
  auto p = builder.prepared(on_feet(10));
  const double square =
      (18 * 1 - 33 * 2 + 33 * 9 - 30 * 1 + 30 * 8 - 19 * 9 + 19 * 2 - 18 * 8) / 2.0;
  cut_covered(p.mesh, p.bodies, std::vector<std::uint8_t>(p.mesh.triangle_count(), 1), p.seals);
  double open = 0;
  for (std::size_t t = 0; t < p.mesh.triangle_count(); ++t)
    if (p.mesh.bears_patches(t) && p.mesh.corner(t, 0).z == 0 && p.mesh.corner(t, 1).z == 0 &&
        p.mesh.corner(t, 2).z == 0)
      open += p.mesh.area_vector2(t).z / 2;
  EXPECT_NEAR(open, 70 * 30 - 200, 1e-6) << square;
}

TEST(Ground, ACourtyardIsOpenGround) {
  auto builder = ModelBuilder().city().object("block", "Building");
  const std::vector<Vec3> outer{{0, 0, 1}, {30, 0, 1}, {30, 30, 1}, {0, 30, 1}};
  const std::vector<Vec3> inner{{10, 10, 1}, {20, 10, 1}, {20, 20, 1}, {10, 20, 1}};
  const auto up = [](Vec3 v) { return v + Vec3{0, 0, 12}; };
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 a = outer[i], b = outer[(i + 1) % 4], c = inner[i], d = inner[(i + 1) % 4];
    builder.ring({a, b, up(b), up(a)}).ring({d, c, up(c), up(d)});
  }
  const std::vector<Vec3> hole{inner[0], inner[3], inner[2], inner[1]};
  std::vector<std::vector<Vec3>> roof{outer, hole};
  for (auto& ring : roof)
    for (Vec3& v : ring) v = up(v);
  builder.polygon(roof).polygon({{outer[0], outer[3], outer[2], outer[1]}, inner});
  builder.object("other", "Building").box({50, 0, 0}, {60, 10, 9});
  const auto p = builder.prepared(on_feet());
  EXPECT_NEAR(plan_area(p.mesh, true), 800 + 100, 1e-6);
  for (const double z : ground_at(p.mesh, 15, 15)) EXPECT_NEAR(z, 1, ground_rounding);
}

TEST(Ground, TerrainOfTheModelGoesFirst) {
  auto builder = ModelBuilder().city().object("terrain", "TINRelief");
  const auto land = [](double x, double y) { return Vec3{x, y, 4 + 0.1 * x + 0.05 * y}; };
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const double x = 10.0 * i, y = 10.0 * j;
      builder.ring({land(x, y), land(x + 10, y), land(x + 10, y + 10), land(x, y + 10)});
    }
  builder.object("on it", "Building").box({12, 12, 5}, {18, 18, 15});
  builder.object("beside", "Building").box({60, 10, 6}, {70, 20, 15});
  const auto p = builder.prepared(on_feet());
  EXPECT_NEAR(p.report.ground->terrain_m2, 1600, 1e-6);
  EXPECT_NEAR(p.report.ground->made_m2, 110 * 80 - 1600, 1e-6);
  EXPECT_EQ(ground_at(p.mesh, 5.1, 5.2).size(), 1u);
  for (const double z : ground_at(p.mesh, 40.001, 20.3)) EXPECT_NEAR(z, 4 + 4 + 1, 0.05);
  for (const double z : ground_at(p.mesh, 60.001, 15)) EXPECT_NEAR(z, 6, 0.01);
  // The house on it ends below: the land there is 5.8 to 6.7 m high.
  EXPECT_LT(p.report.ground->gap_m.front(), -1.5);
}

/// Terrain that rises to the north, 10 %, with a hole from 10 to 30 m and a house in it, whose foot
/// is flat at its lowest land.
double wall_above_land(bool has_hole) {
  auto builder = ModelBuilder().city().object("terrain", "TINRelief").with(Surface::ground);
  const auto land = [](double x, double y) { return Vec3{x, y, 0.1 * y}; };
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) {
      const double x = 5.0 * i, y = 5.0 * j;
      const bool is_in_hole = i >= 2 && i < 6 && j >= 2 && j < 6;
      if (!(has_hole && is_in_hole))
        builder.ring({land(x, y), land(x + 5, y), land(x + 5, y + 5), land(x, y + 5)});
    }
  builder.with(Surface::other).object("house", "Building").box({11, 11, 1.1}, {29, 29, 10});
  auto p = builder.prepared(on_feet());
  Mesh& mesh = p.mesh;
  cut_covered(mesh, p.bodies, std::vector<std::uint8_t>(mesh.triangle_count(), 1), p.seals);
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.triangle_surface[t] == Surface::wall && !mesh.is_covered(t)) area += mesh.area_m2(t);
  return area;
}

TEST(Ground, InAHoleOfTheTerrainAHouseStandsNoDeeperThanOnIt) {
  const double on_it = wall_above_land(false);
  EXPECT_NEAR(on_it, 4 * 18 * (10 - 0.1 * 20), 0.02 * on_it);
  EXPECT_NEAR(wall_above_land(true), on_it, 0.01 * on_it);
}

TEST(Ground, SteepPartsOfTheTerrainAreNotMadeAgain) {
  auto builder = ModelBuilder().city().object("terrain", "TINRelief").with(Surface::ground);
  const auto land = [](double x, double y) { return Vec3{x, y, x > 15 ? 9.0 : 0.0}; };
  for (const double x : {0.0, 10.0, 15.0, 15.5, 30.0}) {
    const double to = x == 0 ? 10 : x == 10 ? 15 : x == 15 ? 15.5 : x == 15.5 ? 30 : 40;
    builder.ring({land(x, 0), land(to, 0), land(to, 40), land(x, 40)});  // a cliff of 87 degrees
  }
  builder.with(Surface::other).object("far", "Building").box({60, 10, 0}, {70, 20, 9});
  const auto p = builder.prepared(on_feet());
  EXPECT_NEAR(p.report.ground->terrain_m2, 1600, 1e-6);
  EXPECT_NEAR(p.report.ground->made_m2, 110 * 80 - 1600, 1e-6);
}

TEST(Ground, WallsThatEndAboveTheTerrainAreDrawnDown) {
  auto builder = ModelBuilder().city().object("terrain", "TINRelief");
  const auto land = [](double x, double y) { return Vec3{x, y, 0.1 * x}; };
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const double x = 10.0 * i, y = 10.0 * j;
      builder.ring({land(x, y), land(x + 10, y), land(x + 10, y + 10), land(x, y + 10)});
    }
  builder.object("house", "Building").box({12, 12, 1.8}, {23, 18, 12});  // land: 1.2 to 2.3 m
  builder.object("mast", "Building").box({30, 30, 9}, {31, 31, 22});     // land: 3 to 3.1 m
  auto p = builder.prepared(on_feet());
  EXPECT_EQ(p.report.ground->drawn, 1u);
  EXPECT_NEAR(p.report.ground->longest_drawn_m, 0.6, ground_rounding);
  EXPECT_EQ(p.report.ground->floating, 1u);
  EXPECT_EQ(p.report.ground->worst.front().object, "mast");
  for (std::size_t t = 1; t < p.mesh.triangle_count(); ++t)
    EXPECT_LE(p.mesh.triangle_object[t - 1], p.mesh.triangle_object[t]);
  // Land under the house and its pocket is covered, and the walls are as long as they are high.
  const std::vector<std::uint8_t> opaque(p.mesh.triangle_count(), 1);
  cut_covered(p.mesh, p.bodies, opaque, p.seals);
  EXPECT_NEAR(plan_area(p.mesh, true), 11 * 6, 1e-6);
  double wall = 0;
  for (std::size_t t = 0; t < p.mesh.triangle_count(); ++t)
    if (p.mesh.triangle_surface[t] == Surface::wall && !p.mesh.is_covered(t) &&
        p.mesh.object_names[p.mesh.triangle_object[t].index()] == "house")
      wall += p.mesh.area_m2(t);
  EXPECT_NEAR(wall, 6 * (10.8 + 9.7) + 2 * 11 * 10.25, 1e-6);
}

TEST(Ground, LevelLiesWhereItIsTold) {
  auto builder = ModelBuilder().object("a").box({0, 0, 2}, {10, 20, 5});
  builder.object("b").box({15, 0, 2.5}, {18, 3, 9});
  PrepareRules rules{.ground = GroundRules{5, GroundSurface::level, 1.2}};
  const auto p = builder.prepared(rules);
  EXPECT_TRUE(p.report.ground->is_level);
  EXPECT_EQ(p.report.ground->low_m, 1.2);
  EXPECT_EQ(p.report.ground->floating, 2u);
  EXPECT_NEAR(p.report.ground->gap_m.front(), 0.8, ground_rounding);
  EXPECT_NEAR(p.report.ground->gap_m.back(), 1.3, ground_rounding);
  EXPECT_EQ(p.report.ground->worst.front().object, "b");
  EXPECT_EQ(p.report.floors, 0u);  // both hover
  EXPECT_NEAR(plan_area(p.mesh, true), 0, ground_rounding);
  rules.ground->height_m.reset();
  const auto lowest = builder.prepared(rules);
  EXPECT_EQ(lowest.report.ground->low_m, 2);
  EXPECT_EQ(lowest.report.ground->floating, 1u);
  EXPECT_NEAR(plan_area(lowest.mesh, true), 200, 1e-6);
}

TEST(Ground, IsRefusedWithoutArea) {
  auto builder = ModelBuilder().object("a").box({0, 0, 2}, {10, 20, 5});
  EXPECT_THROW(builder.prepared(on_feet(-1)), InputError);
  EXPECT_NO_THROW(builder.prepared(on_feet(0)));
}

TEST(Ground, OverlappingHousesOfTwoHeightsFloatNowhere) {
  auto builder = ModelBuilder();
  for (int i = 0; i < 30; ++i) {
    const double a = 0.37 * i, x = 60 * std::fmod(0.618 * i, 1.0),
                 y = 60 * std::fmod(0.755 * i, 1.0);
    const double z = 1.5 * std::fmod(0.414 * i, 1.0);
    auto one = ModelBuilder().object("h").box({-6, -4, z}, {6, 4, z + 10});
    one.moved([&](Vec3 v) {
      return Vec3{x + std::cos(a) * v.x - std::sin(a) * v.y,
                  y + std::sin(a) * v.x + std::cos(a) * v.y, v.z};
    });
    builder.object("house_" + std::to_string(i));
    const auto& model = one.model();
    for (std::size_t f = 0; f < model.polygon_count(); ++f) {
      std::vector<Vec3> ring;
      for (std::size_t k = 0; k < 4; ++k)
        ring.push_back(model.vertices[static_cast<std::size_t>(model.ring_vertex[4 * f + k])]);
      builder.ring(ring);
    }
  }
  const auto p = builder.prepared(on_feet());
  EXPECT_EQ(p.report.ground->standing, 30u);
  expect_on_ground(p, 0.01);
  EXPECT_GT(p.report.ground->gap_m.front(), -1.6);
  const auto again = builder.prepared(on_feet());
  EXPECT_EQ(p.mesh.vertices, again.mesh.vertices);
  EXPECT_EQ(p.mesh.triangles, again.mesh.triangles);
}

}  // namespace
}  // namespace sunload::test
