// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Points of a mesh, found by the line segments that they lie near.
#pragma once

#include <cstdint>
#include <vector>

#include "geo/mesh/mesh.h"

namespace sunload {

/// Boxes in boxes, halved by the number of their points along their longest side. Bentley (1975),
/// Multidimensional binary search trees used for associative searching, with boxes that fit.
class PointTree {
 public:
  /// `points` are indices into `vertices`, which must outlive the tree.
  PointTree(const std::vector<Vec3>& vertices, std::vector<std::int32_t> points);

  /// What a search has found.
  struct Found {
    std::vector<std::int32_t> points;  ///< in no particular order
    std::size_t looks = 0;             ///< boxes and points compared: what the search has cost
  };
  /// All points within `distance` of the segment from `start` to `end`, and some that are further
  /// away. The distance must be more than 1e-12 of the size of the tree.
  Found near_segment(Vec3 start, Vec3 end, double distance) const;

 private:
  struct Node {
    Box box;
    std::uint32_t first, last;   ///< range of points_
    std::uint32_t second_child;  ///< the first one follows its parent; 0: a leaf
  };
  std::uint32_t build(std::uint32_t first, std::uint32_t last);
  Vec3 at(std::int32_t v) const { return vertices_[static_cast<std::size_t>(v)]; }

  const std::vector<Vec3>& vertices_;
  std::vector<std::int32_t> points_;
  std::vector<Node> nodes_;
};

}  // namespace sunload
