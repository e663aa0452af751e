// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The triangles that cast shadows, as the ray caster has them (coordinates rounded to float), with
/// their neighbours across edges and a tree of boxes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geo/mesh/mesh.h"

namespace sunload {

class Occluders {
 public:
  /// `transmittance`: of each triangle; empty where all are opaque.
  Occluders(const Mesh& mesh, std::span<const float> transmittance);

  Vec3 corner(std::size_t triangle, std::size_t k) const { return point_[corners_[triangle][k]]; }
  /// No ray passes it.
  bool is_opaque(std::size_t triangle) const {
    return transmittance_.empty() || transmittance_[triangle] <= 0;
  }
  /// Triangles that have both ends of the edge from corner k to the next, it among them.
  std::span<const std::int32_t> at_edge(std::size_t triangle, std::size_t k) const;
  /// The corner of a triangle that is neither of the two ends of an edge of another.
  Vec3 beside_edge(std::size_t of, std::size_t triangle, std::size_t k) const;

  /// Axis-aligned, as its centre and half its size [m].
  struct Box {
    Vec3 centre, half;
  };
  /// Appends to `found` the triangles in boxes that `meets` does not refuse, in an order of their
  /// own. False where they became more than `most`, and it gave up.
  template <class Meets>
  bool collect(const Meets& meets, std::size_t most, std::vector<std::int32_t>& found) const {
    return nodes_.empty() || collect_from(0, meets, most, found);
  }

 private:
  struct Node {
    Box box;
    std::uint32_t first, count;  ///< of ordered_; count 0: children are the next one and `first`
  };
  void weld(const Mesh& mesh);
  void find_edges();
  void grow(std::uint32_t begin, std::uint32_t end);
  template <class Meets>
  bool collect_from(std::size_t node, const Meets& meets, std::size_t most,
                    std::vector<std::int32_t>& found) const {
    const Node& n = nodes_[node];
    if (!meets(n.box)) return true;
    if (n.count == 0)
      return collect_from(node + 1, meets, most, found) &&
             collect_from(n.first, meets, most, found);
    if (found.size() + n.count > most) return false;
    for (std::uint32_t i = n.first; i < n.first + n.count; ++i) found.push_back(ordered_[i]);
    return true;
  }

  std::vector<Vec3> point_;
  std::vector<std::array<std::uint32_t, 3>> corners_;
  std::vector<float> transmittance_;
  std::vector<std::array<std::uint32_t, 3>> edge_;  ///< per triangle, three numbers of edges
  std::vector<std::uint32_t> edge_begin_;           ///< per edge, into
  std::vector<std::int32_t> at_edge_;
  std::vector<Node> nodes_;
  std::vector<std::int32_t> ordered_;
};

}  // namespace sunload
