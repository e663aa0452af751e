// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Boxes of triangles or edges, found by the box that they meet.
#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "geo/mesh/mesh.h"

namespace sunload {

/// Smallest box around the points.
Box box_around(std::initializer_list<Vec3> points);
Box box_of(const Mesh& mesh, std::size_t triangle);
/// Widens the box until the point is in it; a new Box is of nothing.
void include(Box& box, Vec3 point);
Box widened(Box box, double by);
bool meet(const Box& a, const Box& b);
/// Area in plan that both cover [m²]; 0 where they lie apart.
double shared_plan_m2(const Box& a, const Box& b);
inline Vec3 centre_of(const Box& box) { return (box.low + box.high) * 0.5; }
inline Vec3 half_of(const Box& box) { return (box.high - box.low) * 0.5; }
/// Square of the distance between them; 0 within the box.
inline double distance2(const Box& box, Vec3 p) {
  const Vec3 d{std::max({0.0, box.low.x - p.x, p.x - box.high.x}),
               std::max({0.0, box.low.y - p.y, p.y - box.high.y}),
               std::max({0.0, box.low.z - p.z, p.z - box.high.z})};
  return dot(d, d);
}
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

  /// Appends to `found` the indices of what lies in nodes that `meets` does not refuse, in an order
  /// of its own. False where they became more than `most`, and it gave up.
  template <class Meets>
  bool collect(const Meets& meets, std::size_t most, std::vector<std::int32_t>& found) const {
    return nodes_.empty() || collect_from(0, meets, most, found);
  }
  /// Calls `visit` with the index of what lies in nodes that `meets` does not refuse, near ones
  /// first.
  template <class Meets, class Visit>
  void visit_near_first(Vec3 from, const Meets& meets, const Visit& visit) const {
    if (!nodes_.empty()) visit_from(0, from, meets, visit);
  }

 private:
  struct Node {
    Box box;
    std::uint32_t first, last;   ///< range of order_
    std::uint32_t second_child;  ///< the first one follows its parent; 0: a leaf
  };
  std::uint32_t build(std::uint32_t first, std::uint32_t last);

  template <class Meets>
  bool collect_from(std::uint32_t n, const Meets& meets, std::size_t most,
                    std::vector<std::int32_t>& found) const {
    const Node& node = nodes_[n];
    if (!meets(node.box)) return true;
    if (node.second_child != 0)
      return collect_from(n + 1, meets, most, found) &&
             collect_from(node.second_child, meets, most, found);
    if (found.size() + (node.last - node.first) > most) return false;
    for (std::uint32_t i = node.first; i < node.last; ++i)
      found.push_back(static_cast<std::int32_t>(order_[i]));
    return true;
  }
  template <class Meets, class Visit>
  void visit_from(std::uint32_t n, Vec3 from, const Meets& meets, const Visit& visit) const {
    const Node& node = nodes_[n];
    if (!meets(node.box)) return;
    if (node.second_child == 0) {
      for (std::uint32_t i = node.first; i < node.last; ++i)
        visit(static_cast<std::size_t>(order_[i]));
      return;
    }
    const bool in_order =
        distance2(nodes_[n + 1].box, from) <= distance2(nodes_[node.second_child].box, from);
    visit_from(in_order ? n + 1 : node.second_child, from, meets, visit);
    visit_from(in_order ? node.second_child : n + 1, from, meets, visit);
  }

  std::vector<Box> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace sunload
