// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Trees of elements: tiling, limits, search, keys and order of patches.

#include "solver/mesh/hierarchy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "geo/base/check.h"
#include "solver/base/rng.h"
#include "tests/support/scenes.h"

namespace sunload::test {
namespace {

/// Triangles of many shapes, one of them a sliver, one two-sided.
Scene shapes() {
  SceneBuilder builder;
  const int m = builder.material({"m", 0.3, 0, 0});
  builder.object("a").triangle({0, 0, 0}, {4, 0, 0}, {0, 3, 0}, m);
  builder.triangle({0, 0, 1}, {10, 0, 1}, {10, 0.1, 1}, m);
  builder.object("b").sides(Sides::two).triangle({1, 1, 1}, {3, 4, 0}, {-2, 3, 5}, m);
  builder.sides(Sides::one).object("c").quad({0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, m);
  return builder.scene();
}

double longest_edge(const Hierarchy& h, std::size_t i) {
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k)
    longest = std::max(longest, norm(h.corner(i, (k + 1) % 3) - h.corner(i, k)));
  return longest;
}

TEST(Hierarchy, LeavesTileEveryTriangle) {
  const Scene scene = shapes();
  const Hierarchy h(scene, {.max_edge_m = 0.37});
  ASSERT_EQ(h.area().size(), h.patch_count());
  std::vector<double> front(scene.mesh.triangle_count(), 0), back = front;
  for (std::size_t i = 0; i < h.patch_count(); ++i) {
    const auto t = static_cast<std::size_t>(h.patches()[i].triangle);
    (h.patches()[i].side == 0 ? front : back)[t] += h.area()[i];
    EXPECT_LE(longest_edge(h, i), 0.37);
    const Vec3 n = normalized(scene.mesh.area_vector2(t)) * (h.patches()[i].side == 0 ? 1.0 : -1.0);
    EXPECT_NEAR(dot(n, h.normal(i)), 1, 1e-12);
  }
  for (std::size_t t = 0; t < scene.mesh.triangle_count(); ++t) {
    const double area = scene.mesh.area_m2(t);
    EXPECT_NEAR(front[t], area, 1e-12 * area);
    EXPECT_NEAR(back[t], scene.mesh.triangle_sides[t] == Sides::two ? area : 0, 1e-12 * area);
  }
}

TEST(Hierarchy, WithoutLimitsEveryTriangleIsOnePatch) {
  const Hierarchy h(shapes(), {});
  EXPECT_EQ(h.patch_count(), 2u + 2u + 2u);
}

TEST(Hierarchy, NeverSplitsBelowTwiceTheLeastArea) {
  const Scene scene = shapes();
  const Hierarchy h(scene, {.max_edge_m = 0.1, .min_area_m2 = 0.05});
  for (std::size_t i = 0; i < h.patch_count(); ++i) {
    const auto t = static_cast<std::size_t>(h.patches()[i].triangle);
    const double whole = scene.mesh.area_m2(t);
    EXPECT_GE(h.area()[i], std::min(0.05, whole) * (1 - 1e-12));
    // What was not split may not be split: its edge is short or its area small.
    EXPECT_TRUE(longest_edge(h, i) <= 0.1 || h.area()[i] < 0.1) << h.area()[i];
  }
}

/// Smallest barycentric weight of p in a patch.
double inside(const Hierarchy& h, std::size_t i, Vec3 p) {
  const Vec3 a = h.corner(i, 0), b = h.corner(i, 1), c = h.corner(i, 2);
  const Vec3 n = cross(b - a, c - a);
  const double w1 = dot(cross(p - a, c - a), n) / dot(n, n);
  const double w2 = dot(cross(b - a, p - a), n) / dot(n, n);
  return std::min({1 - w1 - w2, w1, w2});
}

TEST(Hierarchy, FindsThePatchThatHoldsAPoint) {
  const Scene scene = shapes();
  const Hierarchy h(scene, {.max_edge_m = 0.21});
  std::vector<std::pair<double, double>> weights{
      {0, 0},       {1, 0},       {0, 1}, {0.5, 0.5}, {0.5, 0}, {0, 0.5}, {1.0 / 3, 1.0 / 3},
      {0.25, 0.25}, {0.125, 0.75}};
  for (std::uint64_t e = 0; e < 5000; ++e) {
    const RandomWords w = random_words({.element = e});
    double u = uniform(w[0]), v = uniform(w[1]);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    weights.push_back({u, v});
    weights.push_back({u, 0});
    weights.push_back({0, v});
    weights.push_back({u, 1 - u});
  }
  for (std::size_t t = 0; t < scene.mesh.triangle_count(); ++t)
    for (const auto& [u, v] : weights)
      for (const bool front : {true, false}) {
        const auto patch = h.patch_at(static_cast<std::int32_t>(t), u, v, front);
        if (!front && scene.mesh.triangle_sides[t] == Sides::one) {
          ASSERT_EQ(patch, -1);
          continue;
        }
        ASSERT_GE(patch, 0);
        const auto i = static_cast<std::size_t>(patch);
        ASSERT_EQ(h.patches()[i].triangle, static_cast<std::int32_t>(t));
        ASSERT_EQ(h.patches()[i].side, front ? 0 : 1);
        const Vec3 p = scene.mesh.corner(t, 0) * (1 - u - v) + scene.mesh.corner(t, 1) * u +
                       scene.mesh.corner(t, 2) * v;
        // Slivers: weights are ratios of areas, rounding grows with edge² / area.
        const double growth = longest_edge(h, i) * longest_edge(h, i) / h.area()[i];
        ASSERT_GE(inside(h, i, p), -1e-12 * growth) << t << " " << u << " " << v;
      }
}

/// The front patch that holds the point p of a triangle.
std::int32_t holder(const Hierarchy& h, const Scene& scene, std::int32_t triangle, Vec3 p) {
  const auto t = static_cast<std::size_t>(triangle);
  const Vec3 a = scene.mesh.corner(t, 0), b = scene.mesh.corner(t, 1), c = scene.mesh.corner(t, 2);
  const Vec3 n = cross(b - a, c - a);
  const double u = dot(cross(p - a, c - a), n) / dot(n, n);
  const double v = dot(cross(b - a, p - a), n) / dot(n, n);
  return h.patch_at(triangle, u, v, true);
}

TEST(Hierarchy, CentroidsFindTheirOwnPatch) {
  const Scene scene = shapes();
  const Hierarchy h(scene, {.max_edge_m = 0.3});
  for (std::size_t i = 0; i < h.patch_count(); ++i)
    ASSERT_EQ(holder(h, scene, h.patches()[i].triangle, h.centroid(i)),
              static_cast<std::int32_t>(i) - h.patches()[i].side);
}

TEST(Hierarchy, TwinsLieSideBySideWithOppositeNormals) {
  const Hierarchy h(shapes(), {.max_edge_m = 0.5});
  std::size_t twins = 0;
  for (std::size_t i = 0; i < h.patch_count(); ++i) {
    if (h.patches()[i].side != 1) continue;
    ++twins;
    const auto& front = h.patches()[i - 1];
    EXPECT_EQ(front.side, 0);
    EXPECT_EQ(front.triangle, h.patches()[i].triangle);
    EXPECT_EQ(h.area()[i], h.area()[i - 1]);
    EXPECT_EQ(h.centroid(i - 1).x, h.centroid(i).x);
    EXPECT_NEAR(dot(h.normal(i), h.normal(i - 1)), -1, 1e-12);
  }
  EXPECT_GT(twins, 10u);
}

TEST(Hierarchy, FloorsHaveNoPatches) {
  Scene scene = shapes();
  scene.mesh.triangle_surface[0] = Surface::floor;
  const Hierarchy h(scene, {.max_edge_m = 0.5});
  for (const auto& patch : h.patches()) EXPECT_NE(patch.triangle, 0);
  EXPECT_EQ(h.patch_at(0, 0.2, 0.2, true), -1);
  EXPECT_EQ(h.patch_at(0, 0.2, 0.2, false), -1);
}

TEST(Hierarchy, PatchesAreOrderedByTriangleThenPathThenSide) {
  const Hierarchy h(shapes(), {.max_edge_m = 0.5});
  for (std::size_t i = 1; i < h.patch_count(); ++i)
    EXPECT_LE(h.patches()[i - 1].triangle, h.patches()[i].triangle);
  // Depth first: the patches that come from one coarse leaf follow each other, in the
  // order of the coarse leaves.
  const Scene scene = shapes();
  const Hierarchy coarse(scene, {.max_edge_m = 2}), fine(scene, {.max_edge_m = 0.3});
  std::int32_t last = -1;
  for (std::size_t i = 0; i < fine.patch_count(); ++i) {
    const auto& patch = fine.patches()[i];
    if (patch.side == 1) continue;
    const std::int32_t parent = holder(coarse, scene, patch.triangle, fine.centroid(i));
    EXPECT_GE(parent, last);
    last = parent;
  }
  EXPECT_EQ(last, static_cast<std::int32_t>(coarse.patch_count()) - 1);
}

TEST(Hierarchy, KeysAreUniqueAndStableWhenAnotherObjectIsAdded) {
  const auto scene = [](bool with_extra) {
    SceneBuilder builder;
    const int m = builder.material({"m", 0.3, 0, 0});
    if (with_extra)
      builder.object("new_tower").box({20, 0, 0}, {24, 4, 30}, m, SceneBuilder::Facing::outward);
    builder.object("house").box({0, 0, 0}, {5, 7, 3}, m, SceneBuilder::Facing::outward);
    builder.object("screen").sides(Sides::two).quad({9, 0, 0}, {9, 4, 0}, {9, 4, 4}, {9, 0, 4}, m);
    return builder.scene();
  };
  const Scene plain = scene(false), extended = scene(true);
  const Hierarchy before(plain, {.max_edge_m = 0.8}), after(extended, {.max_edge_m = 0.8});
  const std::set<std::uint64_t> unique(after.key().begin(), after.key().end());
  EXPECT_EQ(unique.size(), after.patch_count());
  const std::size_t added = after.patch_count() - before.patch_count();
  ASSERT_GT(added, 0u);
  for (std::size_t i = 0; i < before.patch_count(); ++i) {
    ASSERT_EQ(before.key()[i], after.key()[i + added]);
    ASSERT_EQ(before.centroid(i), after.centroid(i + added));
  }
}

TEST(Hierarchy, RefusesMoreThanMaxPatches) {
  const Scene scene = shapes();
  const std::size_t needed = Hierarchy(scene, {.max_edge_m = 0.5}).patch_count();
  try {
    const Hierarchy h(scene, {.max_edge_m = 0.5, .max_patches = needed - 10});
    ADD_FAILURE() << "not refused";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("max_edge_m"), std::string::npos) << error.what();
  }
  EXPECT_EQ(Hierarchy(scene, {.max_edge_m = 0.5, .max_patches = needed}).patch_count(), needed);
}

}  // namespace
}  // namespace sunload::test
