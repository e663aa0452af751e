// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Triangles that cut through others are found, neighbours are not.

#include "geo/mesh/intersections.h"

#include <gtest/gtest.h>

#include "tests/geo/mesh/mesh_prepare_models.h"

namespace sunload::test {
namespace {

TEST(Intersections, ASoundBodyHasNone) {
  const auto p = ModelBuilder().object("box").box({0, 0, 0}, {2, 3, 4}).prepared();
  const auto found = find_intersections(p.mesh);
  EXPECT_EQ(found.pairs(), 0u);
  EXPECT_EQ(found.triangles, 0u);
}

TEST(Intersections, BodiesThatOverlapHaveSome) {
  auto builder = ModelBuilder().object("one").box({0, 0, 0}, {2, 2, 2});
  builder.object("far").box({5, 0, 0}, {6, 2, 2});
  builder.object("other").box({1, 0.5, 0.5}, {3, 1.5, 1.5});
  const auto p = builder.prepared();
  const auto found = find_intersections(p.mesh);
  EXPECT_GT(found.cutting, 0u);
  EXPECT_EQ(found.covering, 0u);
  EXPECT_EQ(found.between_objects, found.pairs());
  const auto name = [&](std::size_t t) {
    return p.mesh.object_names[p.mesh.triangle_object[t].index()];
  };
  EXPECT_EQ(name(found.first[0]), "one");
  EXPECT_EQ(name(found.first[1]), "other");
}

/// Where they stand on the ground, or on each other, bodies touch.
TEST(Intersections, BodiesThatStandOnTheGroundOnlyTouchIt) {
  auto builder = ModelBuilder().object("one").box({0, 0, 0}, {2, 2, 2});
  const PrepareRules on_plate{.ground = GroundRules{5}};
  EXPECT_EQ(find_intersections(builder.prepared(on_plate).mesh).pairs(), 0u);
  builder.object("beside").box({2, 0.5, 0}, {3, 1.5, 1});
  const auto touching = find_intersections(builder.prepared(on_plate).mesh);
  EXPECT_EQ(touching.cutting, 0u);
  EXPECT_GT(touching.covering, 0u);  // the common wall
  EXPECT_EQ(touching.covering, touching.between_objects);
  builder.object("sunk").box({10, 0, -1}, {12, 2, 2});
  builder.object("land").ring({{8, -2, 0}, {14, -2, 0}, {14, 4, 0}, {8, 4, 0}});
  EXPECT_GT(find_intersections(builder.prepared().mesh).cutting, 0u);
}

TEST(Intersections, PiercedSheetsFoldsAndCovers) {
  const auto of = [](std::vector<std::vector<Vec3>> triangles) {
    ModelBuilder builder;
    builder.object("sheets");
    for (auto& t : triangles) builder.ring(t);
    const auto found =
        find_intersections(builder.prepared({.repair = Repair::none, .ground = {}}).mesh);
    return std::pair{found.cutting, found.covering};
  };
  using Counts = std::pair<std::size_t, std::size_t>;
  const Counts none{0, 0}, cut{1, 0}, cover{0, 1};
  const std::vector<Vec3> flat{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  EXPECT_EQ(of({flat, {{1, 1, -1}, {1, 1, 1}, {1, 9, 1}}}), cut);
  EXPECT_EQ(of({flat, {{5, 5, -1}, {5, 5, 1}, {9, 9, 1}}}), none);
  EXPECT_EQ(of({flat, {{1, 1, 0}, {1, 2, 0}, {1, 1, 1}}}), none);       // stands on it
  EXPECT_EQ(of({flat, {{0, 0, 0}, {2, 2, -1}, {2, 2, 1}}}), cut);       // a common corner, and more
  EXPECT_EQ(of({flat, {{0, 0, 0}, {-1, -1, -1}, {-1, -1, 1}}}), none);  // a common corner alone
  EXPECT_EQ(of({flat, {{0, 0, 0}, {4, 0, 0}, {1, -4, 0}}}), none);      // beyond a common edge
  EXPECT_EQ(of({flat, {{0, 0, 0}, {4, 0, 0}, {1, 1, 3}}}), none);       // risen from it
  EXPECT_EQ(of({flat, {{0, 0, 0}, {4, 0, 0}, {1, 1, 0}}}), cover);      // folded upon it
  EXPECT_EQ(of({flat, {{1, 1, 0}, {2, 1, 0}, {1, 2, 0}}}), cover);
  EXPECT_EQ(of({flat, {{1, 0, 0}, {2, 0, 0}, {1, -2, 0}}}), none);  // a T-joint in its plane
}

}  // namespace
}  // namespace sunload::test
