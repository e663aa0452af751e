// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
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
#include <span>
#include <vector>

#include "solver/mesh/element_forest.h"
#include "solver/surface/material.h"
#include "solver/surface/ray_caster.h"

namespace sunload {

/// A leaf as one of its two sides receives light.
struct Patch {
  std::array<std::int32_t, 3> vertices;  ///< counter-clockwise from its own side
  std::int32_t triangle = -1;
  std::uint8_t side = 0;
};

/// Patches that result at the least, without splitting: a triangle with edges of
/// at most h has at most the area √3/4 h², an element that is not split for its
/// smallness at most 2·min_area. Never more than 10^15.
std::size_t least_patch_count(const Scene& scene, const SplitRules& rules);
/// Throws InputError where even these are more than `max_patches`, and std::logic_error for rules
/// that are none.
void expect_splittable(const Scene& scene, const SplitRules& rules);

/// The finished mesh: never changes, and may be read from any thread.
class Hierarchy {
 public:
  /// Splits every triangle of the scene by `max_edge_m` alone.
  /// Throws InputError where more than `max_patches` would result, and std::logic_error for rules
  /// that are none.
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
  /// Unit, of the patch's own side: its triangle's.
  Vec3 normal(std::size_t patch) const {
    const Patch& of = patches_[patch];
    const Vec3 front = front_[static_cast<std::size_t>(of.triangle)];
    return of.side == 0 ? front : -front;
  }
  Vec3 centroid(std::size_t patch) const;

  /// Patch at the barycentric weights (u, v of corners 1 and 2) of an input
  /// triangle, or -1 where that side has none.
  std::int32_t patch_at(std::int32_t triangle, double u, double v, bool front) const;
  /// The same where the rays of up to `packets_together` have met triangles; -1 for those that have
  /// met none. `patch`: of one packet after the other.
  void patches_at(std::span<const PacketHits> hits, std::int32_t* patch) const;

  /// Elements are numbered patches first, then inner ones, children before parents and tree by
  /// tree. Each side of a two-sided element is one of its own.
  std::size_t element_count() const { return patches_.size() + halves_.size(); }
  /// Element whose half this one is; -1 for roots.
  std::int32_t parent(std::size_t element) const { return parent_[element]; }
  const std::vector<std::int32_t>& parents() const { return parent_; }
  /// Elements whose union is inner element number patch_count() + i.
  const std::array<std::uint32_t, 2>& halves_of(std::size_t i) const { return halves_[i]; }
  std::size_t tree_count() const { return first_inner_.size() - 1; }
  /// Inner elements of a tree are first_inner(tree) … first_inner(tree + 1) - 1.
  std::size_t first_inner(std::size_t tree) const { return first_inner_[tree]; }
  /// A sphere about inner element patch_count() + i.
  struct Sphere {
    float x, y, z, radius;
  };
  const Sphere& sphere(std::size_t i) const { return sphere_[i]; }

 private:
  /// Numbers of an element's two sides; -1 where it has but one.
  using Sides2 = std::array<std::int32_t, 2>;
  Sides2 add_tree(const ElementForest& forest, std::size_t element);
  Sides2 add_leaf(const ElementForest& forest, std::size_t element);
  std::int32_t add_inner(const ElementForest& forest, std::size_t element, std::int32_t half,
                         std::int32_t other_half);

  std::vector<Split> split_;        ///< per element of the forest; of leaves by their first patch
  std::vector<std::int32_t> root_;  ///< per input triangle: 2 · its element, + 1 where it has two
                                    ///< sides; -1: no patches
  std::vector<Vec3> front_;         ///< normal of each input triangle
  std::vector<Patch> patches_;
  std::vector<Vec3> vertices_;
  std::vector<double> area_;
  std::vector<std::uint64_t> key_;
  std::vector<std::int32_t> parent_;                  ///< per element
  std::vector<std::array<std::uint32_t, 2>> halves_;  ///< per inner element
  std::vector<Sphere> sphere_;                        ///< per inner element
  std::vector<std::size_t> first_inner_{0};           ///< per tree
};

}  // namespace sunload
