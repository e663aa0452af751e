// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Trees of elements while they grow: every input triangle is a root, leaves are bisected at
/// their longest edges, neighbours follow where no vertex may be left in the middle of an edge.
///
/// Floors have no trees. Elements keep their numbers; children are appended. The order of splits
/// decides the numbers of vertices and elements, never the shape of the final mesh's trees for a
/// given set of split leaves.
/// Rivara (1997), New longest-edge algorithms for the refinement of unstructured triangulations:
/// the propagation of a split to its neighbours, which ends because every step goes to a longer
/// edge.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "solver/mesh/bisection.h"
#include "solver/mesh/descent.h"
#include "solver/surface/material.h"

namespace sunload {

/// How long and how small elements may be, and how many patches they may make.
struct SplitRules {
  double max_edge_m = 1e9;  ///< above 0: split while the longest edge is longer
  double min_area_m2 = 0;   ///< 0 or more: never split an element below twice this area
  std::size_t max_patches = 100'000'000;
};

/// Throws std::logic_error for lengths and areas that are out of range or no numbers.
void expect_valid(const SplitRules& rules);

/// Only grows: an element is never removed, and the number of one stays as it is.
class ElementForest {
 public:
  /// A triangle of a tree.
  struct Element {
    Corners vertices;
    std::int32_t first_child = -1;  ///< its sibling follows; -1: a leaf
    std::int32_t triangle = -1;
    std::uint64_t path = 1;  ///< 1 for a root, 2·path and 2·path + 1 for its children
    std::uint8_t apex = 0;   ///< corner opposite of the longest edge
    bool is_leaf() const { return first_child < 0; }
  };

  /// One root per triangle that can have patches. `scene` must outlive it.
  explicit ElementForest(const Scene& scene);

  /// Splits until no longest edge exceeds the rule's. Throws InputError beyond `max_patches`, and
  /// std::logic_error for rules that are none.
  void split_long_edges(const SplitRules& rules);
  /// Bisects a leaf. With TVertices::remove every leaf at the split edge is bisected there too,
  /// after those of them whose own longest edge is another one were split first: no area is too
  /// small for that.
  void split(std::size_t leaf, TVertices t_vertices);

  const Scene& scene() const { return scene_; }
  const std::vector<Element>& elements() const { return elements_; }
  const std::vector<Vec3>& vertices() const { return vertices_; }
  std::int32_t root(std::size_t triangle) const { return root_[triangle]; }  ///< -1: none
  Vec3 corner(std::size_t element, std::size_t k) const {
    return vertices_[static_cast<std::size_t>(elements_[element].vertices[k])];
  }
  double area(std::size_t element) const;
  bool is_two_sided(std::size_t element) const;
  /// Stable random key: object name, triangle within it, path.
  std::uint64_t key(std::size_t element) const;
  /// Patches that the leaves make: twins of two-sided ones count twice.
  std::size_t patch_count() const { return patch_count_; }
  /// How each element is split; of leaves by their own numbers.
  const std::vector<Split>& splits() const { return splits_; }
  /// Leaves where the rays of up to `packets_together` have met triangles, whichever side; -1 for
  /// those that have met none. `leaf`: of one packet after the other.
  void leaves_at(std::span<const PacketHits> hits, std::int32_t* leaf) const;

 private:
  std::int32_t midpoint(const Edge& edge);
  void add_leaf(const Element& element);
  void bisect(std::size_t leaf);
  void split_tree(std::size_t element, const SplitRules& rules);
  void split_with_neighbours(std::size_t leaf);
  void link_neighbours();
  void link(std::int32_t leaf);
  void unlink(std::int32_t leaf);
  std::vector<std::int32_t> leaves_at_edge(const Edge& edge) const;

  const Scene& scene_;
  std::vector<Element> elements_;
  std::vector<Split> splits_;
  std::vector<Vec3> vertices_;
  std::vector<std::int32_t> root_;
  std::vector<std::uint64_t> tree_key_;  ///< per triangle
  std::size_t patch_count_ = 0;
  std::unordered_map<std::uint64_t, std::int32_t> midpoints_;
  bool neighbours_are_linked_ = false;
  std::unordered_multimap<std::uint64_t, std::int32_t> leaves_by_edge_;
};

}  // namespace sunload
