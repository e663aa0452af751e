/// Trees of elements: every input triangle is a root, longest edges are
/// bisected, leaves are the patches of the result.
///
/// A leaf of a two-sided triangle makes two patches (side 0 the front, side 1
/// the back). Patches are ordered by object, input triangle, tree path (depth
/// first), side. Floors have no patches: they cast shadows only.
/// Rivara (1984), Algorithms for refining triangular grids: longest-edge bisection.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/element_forest.h"
#include "solver/material.h"

namespace sunload {

struct Patch {
  std::array<std::int32_t, 3> vertices;  ///< counter-clockwise from its own side
  std::int32_t triangle = -1;
  std::uint8_t side = 0;
};

/// Patches that result at the least, without splitting: a triangle with edges of
/// at most h has at most the area √3/4 h², an element that is not split for its
/// smallness at most 2·min_area. Never more than 10^15.
std::size_t least_patch_count(const Scene& scene, const SplitRules& rules);
/// Throws InputError where even these are more than `max_patches`.
void expect_splittable(const Scene& scene, const SplitRules& rules);

class Hierarchy {
 public:
  /// Splits every triangle of the scene by `max_edge_m` alone.
  /// Throws InputError where more than `max_patches` would result.
  Hierarchy(const Scene& scene, const SplitRules& rules);
  /// Freezes trees that have grown.
  explicit Hierarchy(const ElementForest& forest);

  std::size_t patch_count() const { return patches_.size(); }
  const std::vector<Patch>& patches() const { return patches_; }
  /// Vertices of the mesh, then midpoints of split edges [m].
  const std::vector<Vec3>& vertices() const { return vertices_; }
  const std::vector<double>& area() const { return area_; }
  /// Stable random key of a patch: object name, triangle within it, path, side.
  const std::vector<std::uint64_t>& key() const { return key_; }
  Vec3 corner(std::size_t patch, std::size_t k) const {
    return vertices_[static_cast<std::size_t>(patches_[patch].vertices[k])];
  }
  Vec3 normal(std::size_t patch) const;  ///< unit, of the patch's own side
  Vec3 centroid(std::size_t patch) const;

  /// Patch at the barycentric weights (u, v of corners 1 and 2) of an input
  /// triangle, or -1 where that side has none.
  std::int32_t patch_at(std::int32_t triangle, double u, double v, bool front) const;

 private:
  struct Node {
    std::int32_t first_child = -1;  ///< its sibling follows; -1 for a leaf
    std::int32_t first_patch = -1;
    std::uint8_t apex = 0;          ///< corner opposite of the split edge
  };
  void add_leaves(const ElementForest& forest, std::size_t element);

  std::vector<Node> nodes_;
  std::vector<std::int32_t> root_;  ///< per input triangle, -1: no patches
  std::vector<bool> two_sided_;     ///< per input triangle
  std::vector<Patch> patches_;
  std::vector<Vec3> vertices_;
  std::vector<double> area_;
  std::vector<std::uint64_t> key_;
};

}  // namespace sunload
