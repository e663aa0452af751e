/// Triangles that cut through others are found, neighbours are not.

#include "geo/intersections.h"

#include <gtest/gtest.h>

#include "tests/geo/mesh_prepare_models.h"

namespace sunload::test {
namespace {

TEST(Intersections, ASoundBodyHasNone) {
  const auto p = ModelBuilder().object("box").box({0, 0, 0}, {2, 3, 4}).prepared();
  const auto found = find_intersections(p.mesh);
  EXPECT_EQ(found.pairs, 0u);
  EXPECT_EQ(found.triangles, 0u);
}

TEST(Intersections, BodiesThatOverlapHaveSome) {
  auto builder = ModelBuilder().object("one").box({0, 0, 0}, {2, 2, 2});
  builder.object("far").box({5, 0, 0}, {6, 2, 2});
  builder.object("other").box({1, 0.5, 0.5}, {3, 1.5, 1.5});
  const auto p = builder.prepared();
  const auto found = find_intersections(p.mesh);
  EXPECT_GT(found.pairs, 0u);
  EXPECT_EQ(found.between_objects, found.pairs);
  const auto name = [&](std::size_t t) { return p.mesh.object_names[p.mesh.triangle_object[t].index()]; };
  EXPECT_EQ(name(found.first[0]), "one");
  EXPECT_EQ(name(found.first[1]), "other");
}

TEST(Intersections, PiercedSheetsFoldsAndCovers) {
  const auto pairs = [](std::vector<std::vector<Vec3>> triangles) {
    ModelBuilder builder;
    builder.object("sheets");
    for (auto& t : triangles) builder.ring(t);
    return find_intersections(builder.prepared({.repair = Repair::none, .ground = {}}).mesh).pairs;
  };
  const std::vector<Vec3> flat{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  EXPECT_EQ(pairs({flat, {{1, 1, -1}, {1, 1, 1}, {1, 9, 1}}}), 1u);    // through its inside
  EXPECT_EQ(pairs({flat, {{5, 5, -1}, {5, 5, 1}, {9, 9, 1}}}), 0u);    // beside it
  EXPECT_EQ(pairs({flat, {{0, 0, 0}, {1, 1, 0}, {1, 1, 1}}}), 1u);     // a common corner, and more
  EXPECT_EQ(pairs({flat, {{0, 0, 0}, {-1, -1, 0}, {-1, -1, 1}}}), 0u); // a common corner alone
  EXPECT_EQ(pairs({flat, {{0, 0, 0}, {4, 0, 0}, {1, -4, 0}}}), 0u);    // across a common edge
  EXPECT_EQ(pairs({flat, {{0, 0, 0}, {4, 0, 0}, {1, 1, 0}}}), 1u);     // folded upon it
  EXPECT_EQ(pairs({flat, {{1, 1, 0}, {2, 1, 0}, {1, 2, 0}}}), 1u);     // lies upon it
}

}  // namespace
}  // namespace sunload::test
