// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Growing trees: what splits leave behind, with neighbours and without.

#include "solver/mesh/element_forest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "solver/base/rng.h"
#include "solver/mesh/hierarchy.h"
#include "tests/support/scenes.h"

namespace sunload::test {
namespace {

/// A closed box whose eight corners all faces share, longest edges of different lengths.
Scene closed_box() {
  Scene scene = SceneBuilder().scene();
  scene.materials.push_back({"m", 0.3, 0, 0});
  scene.mesh.object_names = {"box"};
  scene.mesh.vertices = {{0, 0, 0},   {3, 0, 0},   {3, 2, 0},   {0, 2, 0},
                         {0, 0, 1.3}, {3, 0, 1.3}, {3, 2, 1.3}, {0, 2, 1.3}};
  scene.mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                          {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  const std::size_t n = scene.mesh.triangles.size();
  scene.mesh.triangle_object.assign(n, make_id<ObjectId>(0));
  scene.mesh.triangle_material.assign(n, MaterialId::none());
  scene.mesh.triangle_facade.assign(n, FacadeId::none());
  scene.mesh.triangle_surface.assign(n, Surface::other);
  scene.mesh.triangle_sides.assign(n, Sides::one);
  scene.material.assign(n, make_id<MaterialId>(0));
  return scene;
}

std::vector<std::size_t> leaves(const ElementForest& forest) {
  std::vector<std::size_t> all;
  for (std::size_t e = 0; e < forest.elements().size(); ++e)
    if (forest.elements()[e].is_leaf()) all.push_back(e);
  return all;
}

/// Edges of leaves that not exactly two of them share: in a closed body, the T-vertices.
std::size_t unmatched_edges(const ElementForest& forest) {
  std::map<Edge, int> count;
  for (const auto leaf : leaves(forest))
    for (std::uint8_t k = 0; k < 3; ++k)
      ++count[edge_opposite(forest.elements()[leaf].vertices, k)];
  std::size_t unmatched = 0;
  for (const auto& [edge, leaves_at] : count) unmatched += leaves_at != 2;
  return unmatched;
}

/// Splits a leaf chosen at random, again and again.
void split_at_random(ElementForest& forest, int times, TVertices t_vertices) {
  for (int i = 0; i < times; ++i) {
    const auto all = leaves(forest);
    const auto word = random_words({.element = static_cast<std::uint64_t>(i)})[0];
    // Every other split falls into the same corner: trees of very different depth.
    forest.split(i % 2 == 0 ? all[word % all.size()] : all.back(), t_vertices);
  }
}

double total_area(const ElementForest& forest) {
  double area = 0;
  for (const auto leaf : leaves(forest)) area += forest.area(leaf);
  return area;
}

TEST(ElementForest, NoVertexIsLeftInTheMiddleOfAnEdge) {
  const Scene scene = closed_box();
  ElementForest forest(scene);
  ASSERT_EQ(unmatched_edges(forest), 0u);
  split_at_random(forest, 400, TVertices::remove);
  EXPECT_GT(leaves(forest).size(), 12u + 400u) << "neighbours are split too";
  EXPECT_EQ(unmatched_edges(forest), 0u);
  EXPECT_NEAR(total_area(forest), 2 * (3 * 2 + 3 * 1.3 + 2 * 1.3), 1e-12);

  ElementForest kept(scene);
  split_at_random(kept, 400, TVertices::keep);
  EXPECT_EQ(leaves(kept).size(), 12u + 400u) << "only what was asked for is split";
  EXPECT_GT(unmatched_edges(kept), 100u) << "planted fault: neighbours are left as they are";
}

TEST(ElementForest, EqualEdgesAreToldApartByTheirPlaceNotByTheirNumbers) {
  Scene scene = closed_box();
  ElementForest forest(scene);
  forest.split_long_edges({.max_edge_m = 0.4});
  // The same box, its vertices in another order.
  Scene renumbered = scene;
  const std::size_t n = scene.mesh.vertices.size();
  for (std::size_t v = 0; v < n; ++v) renumbered.mesh.vertices[v] = scene.mesh.vertices[n - 1 - v];
  for (auto& triangle : renumbered.mesh.triangles)
    for (auto& v : triangle) v = static_cast<std::int32_t>(n) - 1 - v;
  ElementForest other(renumbered);
  other.split_long_edges({.max_edge_m = 0.4});
  const Hierarchy a(forest), b(other);
  ASSERT_EQ(a.patch_count(), b.patch_count());
  EXPECT_EQ(a.key(), b.key());
  for (std::size_t i = 0; i < a.patch_count(); ++i)
    ASSERT_LT(norm(a.centroid(i) - b.centroid(i)), 1e-12) << "patch " << i;
}

/// By a ray that has met it, among others that have met nothing.
std::int32_t leaf_at(const ElementForest& forest, std::int32_t triangle, double u, double v) {
  PacketHits hits{};
  std::fill_n(hits.triangle, packet_size, -1);
  constexpr std::size_t ray = 5;
  hits.triangle[ray] = triangle;
  hits.u[ray] = static_cast<float>(u);
  hits.v[ray] = static_cast<float>(v);
  std::int32_t leaves[packet_size];
  forest.leaves_at({&hits, 1}, leaves);
  return leaves[ray];
}

TEST(ElementForest, FindsTheLeafThatHoldsAPoint) {
  const Scene scene = closed_box();
  ElementForest forest(scene);
  split_at_random(forest, 300, TVertices::remove);
  const Hierarchy frozen(forest);
  for (const auto leaf : leaves(forest)) {
    const auto& e = forest.elements()[leaf];
    const Vec3 centre =
        (forest.corner(leaf, 0) + forest.corner(leaf, 1) + forest.corner(leaf, 2)) / 3;
    const auto t = static_cast<std::size_t>(e.triangle);
    const Vec3 a = scene.mesh.corner(t, 0), n = scene.mesh.area_vector2(t);
    const Vec3 ab = scene.mesh.corner(t, 1) - a, ac = scene.mesh.corner(t, 2) - a;
    const double u = dot(cross(centre - a, ac), n) / dot(n, n);
    const double v = dot(cross(ab, centre - a), n) / dot(n, n);
    EXPECT_EQ(leaf_at(forest, e.triangle, u, v), static_cast<std::int32_t>(leaf));
    const auto patch = frozen.patch_at(e.triangle, u, v, true);
    ASSERT_GE(patch, 0);
    EXPECT_LT(norm(frozen.centroid(static_cast<std::size_t>(patch)) - centre), 1e-12);
  }
}

TEST(ElementForest, KeysOfLeavesAreUnique) {
  const Scene scene = closed_box();
  ElementForest forest(scene);
  split_at_random(forest, 500, TVertices::remove);
  const Hierarchy frozen(forest);
  EXPECT_EQ(std::set<std::uint64_t>(frozen.key().begin(), frozen.key().end()).size(),
            frozen.patch_count());
}

}  // namespace
}  // namespace sunload::test
