// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/mesh/hierarchy.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "geo/base/check.h"
#include "geo/base/keys.h"
#include "solver/base/rng.h"

namespace sunload {

namespace {

/// Trees split by edge length, refused before they are built where they would be too many.
ElementForest split_evenly(const Scene& scene, const SplitRules& rules) {
  expect_splittable(scene, rules);
  ElementForest forest(scene);
  forest.split_long_edges(rules);
  return forest;
}

}  // namespace

std::size_t least_patch_count(const Scene& scene, const SplitRules& rules) {
  const double largest_leaf_m2 =
      std::max(std::sqrt(3.0) / 4 * rules.max_edge_m * rules.max_edge_m, 2 * rules.min_area_m2);
  const Mesh& mesh = scene.mesh;
  double count = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!mesh.bears_patches(t)) continue;
    const double area_m2 = mesh.area_m2(t);
    const double leaves = std::max(1.0, std::ceil(area_m2 / largest_leaf_m2));
    count += mesh.triangle_sides[t] == Sides::two ? 2 * leaves : leaves;
  }
  constexpr double beyond_any_machine = 1e15;
  return static_cast<std::size_t>(std::min(count, beyond_any_machine));
}

void expect_splittable(const Scene& scene, const SplitRules& rules) {
  expect_valid(rules);
  if (least_patch_count(scene, rules) > rules.max_patches)
    throw InputError({}, "more than " + std::to_string(rules.max_patches) + " patches",
                     "mesh.max_edge_m is too small for this scene", "use a larger one");
}

Hierarchy::Hierarchy(const Scene& scene, const SplitRules& rules)
    : Hierarchy(split_evenly(scene, rules)) {}

Hierarchy::Hierarchy(const ElementForest& forest)
    : split_(forest.splits()), vertices_(forest.vertices()) {
  const Mesh& mesh = forest.scene().mesh;
  patches_.reserve(forest.patch_count());
  area_.reserve(forest.patch_count());
  key_.reserve(forest.patch_count());
  parent_.assign(forest.patch_count(), -1);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    front_.push_back(mesh.normal(t));
    const auto root = forest.root(t);
    root_.push_back(root < 0 ? -1 : 2 * root + (mesh.triangle_sides[t] == Sides::two ? 1 : 0));
    if (root < 0) continue;
    add_tree(forest, static_cast<std::size_t>(root));
    first_inner_.push_back(halves_.size());
  }
}

Hierarchy::Sides2 Hierarchy::add_tree(const ElementForest& forest, std::size_t element) {
  const auto& e = forest.elements()[element];
  if (e.is_leaf()) return add_leaf(forest, element);
  const auto child = static_cast<std::size_t>(e.first_child);
  const Sides2 half = add_tree(forest, child), other = add_tree(forest, child + 1);
  Sides2 sides{-1, -1};
  for (std::size_t side = 0; side < 2; ++side)
    if (half[side] >= 0) sides[side] = add_inner(forest, element, half[side], other[side]);
  return sides;
}

Hierarchy::Sides2 Hierarchy::add_leaf(const ElementForest& forest, std::size_t element) {
  const auto& e = forest.elements()[element];
  split_[element] = -1 - static_cast<std::int32_t>(patches_.size());
  const auto& c = e.vertices;
  Sides2 sides{-1, -1};
  const std::uint8_t count = forest.is_two_sided(element) ? 2 : 1;
  for (std::uint8_t side = 0; side < count; ++side) {
    sides[side] = static_cast<std::int32_t>(patches_.size());
    patches_.push_back({side == 0 ? c : Corners{c[0], c[2], c[1]}, e.triangle, side});
    area_.push_back(forest.area(element));
    key_.push_back(mixed(forest.key(element), side));
  }
  return sides;
}

std::int32_t Hierarchy::add_inner(const ElementForest& forest, std::size_t element,
                                  std::int32_t half, std::int32_t other_half) {
  const auto number = static_cast<std::int32_t>(parent_.size());
  parent_.push_back(-1);
  parent_[static_cast<std::size_t>(half)] = parent_[static_cast<std::size_t>(other_half)] = number;
  halves_.push_back({static_cast<std::uint32_t>(half), static_cast<std::uint32_t>(other_half)});
  // No point of a triangle is farther from the middle of its longest edge than half of that edge
  // or the median to it.
  const auto& e = forest.elements()[element];
  const auto [p, q] = edge_opposite(e.vertices, e.apex);
  const Vec3 a = vertices_[static_cast<std::size_t>(p)], b = vertices_[static_cast<std::size_t>(q)];
  const Vec3 middle = (a + b) / 2;
  const double radius = std::max(norm(b - a) / 2, norm(forest.corner(element, e.apex) - middle));
  sphere_.push_back({static_cast<float>(middle.x), static_cast<float>(middle.y),
                     static_cast<float>(middle.z), static_cast<float>(radius)});
  return number;
}

Vec3 Hierarchy::centroid(std::size_t patch) const {
  return (corner(patch, 0) + corner(patch, 1) + corner(patch, 2)) / 3;
}

std::int32_t Hierarchy::patch_at(std::int32_t triangle, double u, double v, bool front) const {
  const auto root = root_[static_cast<std::size_t>(triangle)];
  if (root < 0 || (!front && root % 2 == 0)) return -1;
  PointColumns<1> point;
  point.put(0, split_[static_cast<std::size_t>(root / 2)], u, v);
  descend(split_.data(), point);
  return -1 - point.split[0] + (front ? 0 : 1);
}

void Hierarchy::patches_at(std::span<const PacketHits> hits, std::int32_t* patch) const {
  find_leaves(
      split_, hits,
      [this](const PacketHits& of, std::size_t l) {
        const auto root = of.triangle[l] < 0 ? -1 : root_[static_cast<std::size_t>(of.triangle[l])];
        return root >= 0 && (of.front[l] || root % 2 != 0) ? root / 2 : -1;
      },
      patch);
  // Leaves are numbered by their fronts.
  for (std::size_t p = 0; p < hits.size(); ++p)
    for (std::size_t l = 0; l < packet_size; ++l)
      if (std::int32_t& found = patch[p * packet_size + l]; found >= 0 && !hits[p].front[l])
        ++found;
}

}  // namespace sunload
