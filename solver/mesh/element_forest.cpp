// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/mesh/element_forest.h"

#include <string>

#include "geo/base/check.h"
#include "geo/base/keys.h"
#include "solver/base/rng.h"

namespace sunload {

namespace {

std::uint64_t packed(const Edge& edge) {
  return static_cast<std::uint64_t>(edge.first) << 32 | static_cast<std::uint32_t>(edge.second);
}

[[noreturn]] void refuse_size(std::size_t max_patches) {
  throw InputError({}, "more than " + std::to_string(max_patches) + " patches",
                   "mesh.max_edge_m is too small for this scene", "use a larger one");
}

}  // namespace

ElementForest::ElementForest(const Scene& scene)
    : scene_(scene), vertices_(scene.mesh.vertices), root_(scene.mesh.triangle_count(), -1) {
  expect_valid(scene);
  const Mesh& mesh = scene.mesh;
  std::vector<std::uint64_t> number_in_object(mesh.object_names.size(), 0);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const auto object = mesh.triangle_object[t].index();
    tree_key_.push_back(mixed(text_key(mesh.object_names[object]), number_in_object[object]++));
    if (!mesh.bears_patches(t)) continue;
    root_[t] = static_cast<std::int32_t>(elements_.size());
    add_leaf({mesh.triangles[t], -1, static_cast<std::int32_t>(t), 1,
              apex_of_longest_edge(vertices_, mesh.triangles[t])});
    patch_count_ += is_two_sided(elements_.size() - 1) ? 2u : 1u;
  }
}

double ElementForest::area(std::size_t element) const {
  const Vec3 a = corner(element, 0);
  return norm(cross(corner(element, 1) - a, corner(element, 2) - a)) / 2;
}

bool ElementForest::is_two_sided(std::size_t element) const {
  return scene_.mesh.triangle_sides[static_cast<std::size_t>(elements_[element].triangle)] ==
         Sides::two;
}

std::uint64_t ElementForest::key(std::size_t element) const {
  const Element& e = elements_[element];
  return mixed(tree_key_[static_cast<std::size_t>(e.triangle)], e.path);
}

void ElementForest::add_leaf(const Element& element) {
  SUNLOAD_EXPECT(elements_.size() < most_elements, "numbers of elements fit their splits");
  splits_.push_back(-1 - static_cast<Split>(elements_.size()));
  elements_.push_back(element);
}

std::int32_t ElementForest::midpoint(const Edge& edge) {
  const auto [place, is_new] =
      midpoints_.try_emplace(packed(edge), static_cast<std::int32_t>(vertices_.size()));
  if (is_new)
    vertices_.push_back((vertices_[static_cast<std::size_t>(edge.first)] +
                         vertices_[static_cast<std::size_t>(edge.second)]) /
                        2);
  return place->second;
}

void ElementForest::bisect(std::size_t leaf) {
  const Element parent = elements_[leaf];
  const std::int32_t m = midpoint(edge_opposite(parent.vertices, parent.apex));
  const auto children = halves(parent.vertices, parent.apex, m);
  elements_[leaf].first_child = static_cast<std::int32_t>(elements_.size());
  splits_[leaf] = 4 * elements_[leaf].first_child + parent.apex;
  for (std::uint64_t c = 0; c < 2; ++c)
    add_leaf({children[c], -1, parent.triangle, 2 * parent.path + c,
              apex_of_longest_edge(vertices_, children[c])});
  patch_count_ += is_two_sided(leaf) ? 2u : 1u;
  if (!neighbours_are_linked_) return;
  unlink(static_cast<std::int32_t>(leaf));
  link(elements_[leaf].first_child);
  link(elements_[leaf].first_child + 1);
}

void expect_valid(const SplitRules& rules) {
  SUNLOAD_EXPECT(rules.max_edge_m > 0, "edges that can be reached");
  SUNLOAD_EXPECT(rules.min_area_m2 >= 0, "an area");
}

void ElementForest::split_long_edges(const SplitRules& rules) {
  expect_valid(rules);
  for (const auto root : root_)
    if (root >= 0) split_tree(static_cast<std::size_t>(root), rules);
}

void ElementForest::split_tree(std::size_t element, const SplitRules& rules) {
  const auto [p, q] = edge_opposite(elements_[element].vertices, elements_[element].apex);
  const double longest_m =
      norm(vertices_[static_cast<std::size_t>(q)] - vertices_[static_cast<std::size_t>(p)]);
  if (longest_m <= rules.max_edge_m || area(element) < 2 * rules.min_area_m2) return;
  bisect(element);
  if (patch_count_ > rules.max_patches) refuse_size(rules.max_patches);
  const auto child = static_cast<std::size_t>(elements_[element].first_child);
  split_tree(child, rules);
  split_tree(child + 1, rules);
}

void ElementForest::split(std::size_t leaf, TVertices t_vertices) {
  SUNLOAD_EXPECT(elements_[leaf].is_leaf(), "only leaves are split");
  if (t_vertices == TVertices::keep) return bisect(leaf);
  if (!neighbours_are_linked_) link_neighbours();
  split_with_neighbours(leaf);
}

void ElementForest::split_with_neighbours(std::size_t leaf) {
  const Edge edge = edge_opposite(elements_[leaf].vertices, elements_[leaf].apex);
  const auto splits_elsewhere = [&](std::int32_t other) {
    const Element& e = elements_[static_cast<std::size_t>(other)];
    return edge_opposite(e.vertices, e.apex) != edge;
  };
  // A neighbour is split at longer edges until this one is the longest of what is left of it.
  for (bool all_agree = false; !all_agree;) {
    all_agree = true;
    for (const auto other : leaves_at_edge(edge)) {
      if (!splits_elsewhere(other)) continue;
      split_with_neighbours(static_cast<std::size_t>(other));
      all_agree = false;
      break;
    }
  }
  for (const auto each : leaves_at_edge(edge)) bisect(static_cast<std::size_t>(each));
}

void ElementForest::link_neighbours() {
  neighbours_are_linked_ = true;
  for (std::size_t e = 0; e < elements_.size(); ++e)
    if (elements_[e].is_leaf()) link(static_cast<std::int32_t>(e));
}

void ElementForest::link(std::int32_t leaf) {
  for (std::uint8_t k = 0; k < 3; ++k)
    leaves_by_edge_.emplace(
        packed(edge_opposite(elements_[static_cast<std::size_t>(leaf)].vertices, k)), leaf);
}

void ElementForest::unlink(std::int32_t leaf) {
  for (std::uint8_t k = 0; k < 3; ++k) {
    auto [at, end] = leaves_by_edge_.equal_range(
        packed(edge_opposite(elements_[static_cast<std::size_t>(leaf)].vertices, k)));
    while (at != end && at->second != leaf) ++at;
    if (at != end) leaves_by_edge_.erase(at);
  }
}

std::vector<std::int32_t> ElementForest::leaves_at_edge(const Edge& edge) const {
  std::vector<std::int32_t> leaves;
  const auto [begin, end] = leaves_by_edge_.equal_range(packed(edge));
  for (auto at = begin; at != end; ++at) leaves.push_back(at->second);
  return leaves;
}

void ElementForest::leaves_at(std::span<const PacketHits> hits, std::int32_t* leaf) const {
  find_leaves(
      splits_, hits,
      [this](const PacketHits& of, std::size_t l) {
        return of.triangle[l] < 0 ? -1 : root_[static_cast<std::size_t>(of.triangle[l])];
      },
      leaf);
}

}  // namespace sunload
