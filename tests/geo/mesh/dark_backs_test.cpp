// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/dark_backs.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/geo/mesh/mesh_prepare_models.h"

namespace sunload::test {
namespace {

const std::vector<Vec3> meadow{{-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}};

/// A meadow and, on it, a house whose faces have two sides.
ModelBuilder house_on_meadow() {
  ModelBuilder model;
  model.object("meadow").with(Surface::ground).ring(meadow);
  return model.object("house").with(Surface::other, Sides::two);
}

struct Backs {
  std::size_t dark = 0, lit = 0;  ///< of the house
};
Backs backs_of(const ModelBuilder& model, const PrepareRules& rules = {}, bool is_opaque = true) {
  const PreparedMesh p = model.prepared(rules);
  const std::vector<std::uint8_t> opaque(p.mesh.triangle_count(), is_opaque);
  const auto dark = dark_backs(p.mesh, p.bodies, opaque);
  Backs backs;
  for (std::size_t t = 0; t < dark.size(); ++t) {
    const bool is_house = p.mesh.object_names[p.mesh.triangle_object[t].index()] == "house";
    EXPECT_TRUE(is_house || dark[t] == 0) << t;
    if (is_house) ++(dark[t] != 0 ? backs.dark : backs.lit);
  }
  return backs;
}
void expect_dark(const ModelBuilder& model, std::size_t triangles) {
  const Backs backs = backs_of(model);
  EXPECT_EQ(backs.dark, triangles);
  EXPECT_EQ(backs.lit, 0u);
}
void expect_lit(const ModelBuilder& model, const PrepareRules& rules = {}, bool is_opaque = true) {
  EXPECT_EQ(backs_of(model, rules, is_opaque).dark, 0u);
}

TEST(DarkBacks, AreThoseOfAClosedBodyWhereverItIs) {
  expect_dark(house_on_meadow().box({0, 0, 0}, {8, 6, 5}), 12);
  expect_dark(house_on_meadow().box({0, 0, 3}, {8, 6, 5}), 12);
}

TEST(DarkBacks, AreThoseOfAHouseThatTheLandCloses) {
  expect_dark(house_on_meadow().walls_and_roof({0, 0, 0}, {8, 6, 5}), 10);
  expect_dark(house_on_meadow().walls_and_roof({0, 0, -0.5}, {8, 6, 5}), 10);  // sunk into it
  expect_lit(house_on_meadow().walls_and_roof({0, 0, 0.5}, {8, 6, 5}));        // on stilts
  expect_lit(house_on_meadow().walls_and_roof({46, 0, 0}, {54, 6, 5}));        // beyond its end
  ModelBuilder no_land;
  no_land.object("house").with(Surface::other, Sides::two).walls_and_roof({0, 0, 0}, {8, 6, 5});
  expect_lit(no_land);
}

/// What light enters: a door, a wall that is missing, a fence.
TEST(DarkBacks, AreNotWhereSomethingIsOpenAboveTheLand) {
  auto no_wall = house_on_meadow();
  no_wall.ring({{0, 0, 0}, {8, 0, 0}, {8, 0, 5}, {0, 0, 5}});
  no_wall.ring({{8, 0, 0}, {8, 6, 0}, {8, 6, 5}, {8, 0, 5}});
  no_wall.ring({{0, 6, 0}, {0, 0, 0}, {0, 0, 5}, {0, 6, 5}});
  no_wall.ring({{0, 0, 5}, {8, 0, 5}, {8, 6, 5}, {0, 6, 5}});
  expect_lit(no_wall);
  auto door = no_wall;
  door.polygon(
      {{{8, 6, 0}, {5, 6, 0}, {5, 6, 2}, {4, 6, 2}, {4, 6, 0}, {0, 6, 0}, {0, 6, 5}, {8, 6, 5}}});
  expect_lit(door);
  expect_lit(house_on_meadow().ring({{0, 0, 0}, {8, 0, 0}, {8, 0, 2}, {0, 0, 2}}));
}

TEST(DarkBacks, AreNotWhereLightPassesOrFrontsLookInward) {
  expect_lit(house_on_meadow().box({0, 0, 0}, {8, 6, 5}), {}, false);
  PrepareRules kept;
  kept.orientation = Orientation::keep;
  auto inward = house_on_meadow();
  for (auto face : ModelBuilder::box_faces({0, 0, 0}, {8, 6, 5})) {
    std::reverse(face.begin(), face.end());
    inward.ring(face);
  }
  expect_lit(inward, kept);
  expect_dark(inward, 12);  // turned over
}

}  // namespace
}  // namespace sunload::test
