// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Houses without a floor that stand on land, or on other houses, hide what is inside of them.
#include "geo/mesh/solid_bodies.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "geo/mesh/covered.h"
#include "geo/mesh/slope.h"
#include "tests/geo/mesh/mesh_prepare_models.h"

namespace sunload::test {
namespace {

constexpr double rounding_m2 = 1e-6;
constexpr double cut_m2 = 1e-4;  ///< of many lines that cross
/// Land ends as far before walls as surfaces are looked at: 4 mm.
constexpr double looked_at_m = 4e-3;

/// What stands on land of the file, or on ground that is made for it.
enum class On { land, made_ground };

ModelBuilder begun(On on) {
  ModelBuilder model;
  if (on == On::land) {
    model.object("land", "TINRelief").with(Surface::ground);
    model.ring({{-50, -50, 0}, {60, -50, 0}, {60, 60, 0}, {-50, 60, 0}}).with(Surface::other);
  }
  return model;
}

/// Areas of patches [m2].
struct Open {
  double walls = 0, roofs = 0, others = 0, land = 0;
};

Open open_of(const ModelBuilder& model, On on) {
  PrepareRules rules;
  if (on == On::made_ground) {
    rules.ground = GroundRules{};
    rules.ground->surface = GroundSurface::level;
    rules.ground->height_m = 0;
  }
  PreparedMesh p = model.prepared(rules);
  cut_covered(p.mesh, p.bodies, std::vector<std::uint8_t>(p.mesh.triangle_count(), 1), p.seals);
  Open open;
  for (std::size_t t = 0; t < p.mesh.triangle_count(); ++t) {
    if (p.mesh.is_covered(t) || !p.mesh.bears_patches(t)) continue;
    const Surface kind = p.mesh.triangle_surface[t];
    (kind == Surface::wall     ? open.walls
     : kind == Surface::roof   ? open.roofs
     : kind == Surface::ground ? open.land
                               : open.others) += p.mesh.area_m2(t);
  }
  return open;
}

constexpr std::array both{On::land, On::made_ground};

// Terraces as one mesh, as many exports have a whole town.
TEST(SolidBodies, PartyWallsOfOneObjectAreCoveredAsFarAsBothHousesHaveThem) {
  for (const On on : both)
    for (const double height_m : {9.0, 12.0}) {
      ModelBuilder model = begun(on);
      model.object("town").walls_and_roof({0, 0, 0}, {10, 8, 9});
      model.walls_and_roof({10, 0, 0}, {20, 8, height_m});
      const Open open = open_of(model, on);
      EXPECT_NEAR(open.walls, 28 * 9 + 28 * height_m + 8 * (height_m - 9), rounding_m2) << height_m;
      EXPECT_NEAR(open.roofs, 160, rounding_m2);
      EXPECT_EQ(open.others, 0);
    }
}

TEST(SolidBodies, PartitionsAndSlabsAreCovered) {
  for (const On on : both) {
    ModelBuilder model = begun(on);
    model.object("house").walls_and_roof({0, 0, 0}, {10, 8, 9});
    model.ring({{0, 0, 3}, {10, 0, 3}, {10, 8, 3}, {0, 8, 3}});  // joined to no edge
    const Open open = open_of(model, on);
    EXPECT_NEAR(open.walls + open.roofs + open.others, 36 * 9 + 80, rounding_m2);
  }
}

// The line along a roof or a wall where what is inside begins.
TEST(SolidBodies, WhatReachesIntoAHouseIsCutAtItsSurface) {
  for (const On on : both)
    for (const bool is_one_object : {false, true}) {
      ModelBuilder model = begun(on);
      model.object("house").walls_and_roof({0, 0, 0}, {10, 8, 9});
      if (!is_one_object) model.object("parts");
      model.walls_and_roof({4, 3, 5}, {5, 4, 11});    // a chimney, of which 2 m are seen
      model.walls_and_roof({8, 2, 0}, {16, 6, 6});    // a wing
      model.walls_and_roof({1, 1, 9}, {3, 3, 11.5});  // what stands on the roof
      const Open open = open_of(model, on);
      EXPECT_NEAR(open.walls, (36 * 9 - 4 * 6) + 4 * 2 + (2 * 6 + 4) * 6 + 8 * 2.5, rounding_m2);
      EXPECT_NEAR(open.roofs, 80 + 6 * 4, rounding_m2);
      EXPECT_EQ(open.others, 0);
    }
}

TEST(SolidBodies, WhatLightComesIntoFromBelowIsNone) {
  ModelBuilder model = begun(On::land);
  model.object("canopy").walls_and_roof({0, 0, 4}, {10, 8, 5});
  model.object("below").walls_and_roof({4, 3, 0}, {5, 4, 4.5});
  const Open open = open_of(model, On::land);
  EXPECT_NEAR(open.walls, 36 * 1 + 4 * 4.5, rounding_m2);
  EXPECT_NEAR(open.land, 110 * 110 - 1, 4 * 1.01 * looked_at_m);
  // On a slope whose land its level foot leaves: half of it is open.
  ModelBuilder slope;
  slope.object("land", "TINRelief").with(Surface::ground);
  slope.ring({{-50, -50, -5}, {60, -50, -5}, {60, 60, 6}, {-50, 60, 6}}).with(Surface::other);
  slope.object("house").walls_and_roof({0, -4, 0}, {10, 4, 9});
  slope.object("within").ring({{5, -4, 3}, {5, 4, 3}, {5, 4, 8}, {5, -4, 8}});
  EXPECT_GE(open_of(slope, On::land).walls, 36 * 9 - 3.5 * 5);
}

TEST(SolidBodies, ATerrainOnSkirtsIsNone) {
  ModelBuilder model = begun(On::land);
  model.object("plate", "TINRelief").walls_and_roof({0, 0, 0}, {20, 20, 2});
  const PreparedMesh p = model.prepared();
  const auto solid =
      solid_bodies(p.mesh, p.bodies, std::vector<std::uint8_t>(p.mesh.triangle_count(), 1), 2e-3);
  EXPECT_EQ(std::count(solid.begin(), solid.end(), 1), 0);
}

/// With or without floors, in one object or several, the same is seen of them.
TEST(SolidBodies, RandomHousesWithoutFloorsShowWhatThoseWithFloorsShow) {
  std::mt19937 random(7);  // NOLINT(cert-msc51-cpp): the same boxes in every run
  std::uniform_real_distribution<double> at(0, 24), size(2, 11), height(3, 12);
  for (int round = 0; round < 6; ++round) {
    ModelBuilder with = begun(On::land), without = begun(On::land), town = begun(On::land);
    town.object("town");
    for (int k = 0; k < 8; ++k) {
      const Vec3 a{at(random), at(random), 0},
          b = a + Vec3{size(random), size(random), height(random)};
      with.object("h" + std::to_string(k)).box(a, b);
      without.object("h" + std::to_string(k)).walls_and_roof(a, b);
      town.walls_and_roof(a, b);
    }
    const Open expected = open_of(with, On::land);
    for (const ModelBuilder* model : {&without, &town}) {
      const Open open = open_of(*model, On::land);
      EXPECT_NEAR(open.walls, expected.walls, cut_m2) << round;
      EXPECT_NEAR(open.roofs, expected.roofs, cut_m2) << round;
      EXPECT_NEAR(open.land, expected.land, 300 * looked_at_m) << round;
    }
  }
}

// Walls of two houses that lie on each other stand on one edge: the houses are no less open there
// than elsewhere. One mesh, without floors; the second house is shorter, or has as much wall as the
// gable of the first.
TEST(SolidBodies, AreTwoHousesOfOneMeshWhosePartyWallsShareTheirFeet) {
  for (const On on : both) {
    auto shorter = begun(on);
    shorter.object("row").walls_and_roof({8, 8, 0}, {12, 14, 2});
    shorter.walls_and_roof({6, 8, 0}, {8, 10, 2});
    const Open open = open_of(shorter, on);
    EXPECT_NEAR(open.walls, (4 + 6 + 6 + 2 + 4 + 2) * 2, rounding_m2);
    EXPECT_NEAR(open.roofs, 4 * 6 + 2 * 2, rounding_m2);
    EXPECT_NEAR(open.others, 0, rounding_m2);

    auto gable = begun(on);
    gable.object("row").ring({{6, 4, 0}, {10, 4, 0}, {10, 4, 6}, {6, 4, 6}});
    gable.ring({{10, 6, 0}, {6, 6, 0}, {6, 6, 6}, {10, 6, 6}});
    gable.ring({{10, 4, 0}, {10, 6, 0}, {10, 6, 6}, {10, 5, 8}, {10, 4, 6}});
    gable.ring({{6, 6, 0}, {6, 4, 0}, {6, 4, 6}, {6, 5, 8}, {6, 6, 6}});
    gable.ring({{6, 4, 6}, {10, 4, 6}, {10, 5, 8}, {6, 5, 8}});
    gable.ring({{10, 6, 6}, {6, 6, 6}, {6, 5, 8}, {10, 5, 8}});
    gable.walls_and_roof({10, 4, 0}, {12, 6, 6});
    const Open of_gable = open_of(gable, on);
    EXPECT_NEAR(of_gable.walls, 2 * 4 * 6 + 2 * 6 + 2 * 2 + (2 + 2 + 2) * 6, rounding_m2);
    EXPECT_NEAR(of_gable.roofs, 2 * 4 * std::sqrt(5.0) + 2 * 2, rounding_m2);
  }
}

// Walls of three houses stand on one edge; a low house and a high one on the same outline.
TEST(SolidBodies, AreHousesOfOneMeshOfWhichSeveralShareFeet) {
  const std::vector<std::vector<std::array<Vec3, 2>>> heaps{
      {{{{6, 1, 0}, {7, 3, 3}}}, {{{6, 3, 0}, {8, 6, 2}}}, {{{4, 3, 0}, {7, 5, 3}}}},
      {{{{2, 0, 0}, {5, 3, 3}}}, {{{2, 0, 0}, {5, 3, 2}}}},
      {{{{2, 0, 0}, {5, 3, 3}}}, {{{2, 0, 0}, {5, 3, 2}}}, {{{2, 0, 0}, {5, 3, 1}}}},
      {{{{0, 0, 0}, {10, 8, 6}}}, {{{4, 0, 0}, {10, 8, 6}}}}};
  for (const On on : both)
    for (const auto& heap : heaps) {
      auto with = begun(on), town = begun(on);
      town.object("town");
      for (const auto& [a, b] : heap) {
        with.object("h" + std::to_string(with.model().object_names.size())).box(a, b);
        town.walls_and_roof(a, b);
      }
      const Open expected = open_of(with, on), open = open_of(town, on);
      EXPECT_NEAR(open.walls, expected.walls, rounding_m2);
      EXPECT_NEAR(open.roofs, expected.roofs, rounding_m2);
      EXPECT_NEAR(open.others, 0, rounding_m2);
    }
}

}  // namespace
}  // namespace sunload::test
