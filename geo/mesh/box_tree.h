// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Boxes of triangles or edges, found by the box that they meet.
#pragma once

#include <cstdint>
#include <vector>

#include "geo/mesh/mesh.h"

namespace sunload {

/// Smallest box around the points.
Box box_around(std::initializer_list<Vec3> points);
Box widened(Box box, double by);
bool meet(const Box& a, const Box& b);
/// The box at all heights: asks for what lies in the same place in plan.
Box upright(Box box);
/// The box at height 0, for trees that are asked by upright boxes only. (Upright ones in a tree
/// would leave it nothing to halve.)
Box in_plan(Box box);

/// Boxes in boxes, halved by their number along the longest side (as `PointTree`, with boxes for
/// points). Equal input gives the same tree.
class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(std::vector<Box> boxes);

  /// Calls `visit` with the index of every box that meets `box`, in no particular order.
  template <class Visit>
  void visit_meeting(const Box& box, const Visit& visit) const {
    if (nodes_.empty()) return;
    std::vector<std::uint32_t> open{0};
    while (!open.empty()) {
      const std::uint32_t n = open.back();
      const Node& node = nodes_[n];
      open.pop_back();
      if (!meet(node.box, box)) continue;
      if (node.second_child != 0) {
        open.push_back(node.second_child);
        open.push_back(n + 1);
        continue;
      }
      for (std::uint32_t i = node.first; i < node.last; ++i)
        if (meet(boxes_[order_[i]], box)) visit(static_cast<std::size_t>(order_[i]));
    }
  }
  /// The same for all boxes above and below a point.
  template <class Visit>
  void visit_column(double x, double y, const Visit& visit) const {
    visit_meeting(upright({{x, y, 0}, {x, y, 0}}), visit);
  }

 private:
  struct Node {
    Box box;
    std::uint32_t first, last;   ///< range of order_
    std::uint32_t second_child;  ///< the first one follows its parent; 0: a leaf
  };
  std::uint32_t build(std::uint32_t first, std::uint32_t last);

  std::vector<Box> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace sunload
