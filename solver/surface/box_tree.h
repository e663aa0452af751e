// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A tree of boxes about things that are numbered from 0.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geo/base/vec.h"

namespace sunload {

class BoxTree {
 public:
  /// Axis-aligned, as its centre and half its size [m].
  struct Box {
    Vec3 centre, half;
  };
  static Box box_about(std::span<const Vec3> points);

  BoxTree() = default;
  /// Halved at the median of the boxes' centres, down to some few in a leaf.
  explicit BoxTree(const std::vector<Box>& boxes);

  /// Appends to `found` what lies in boxes that `meets` does not refuse, in an order of its own.
  /// False where they became more than `most`, and it gave up.
  template <class Meets>
  bool collect(const Meets& meets, std::size_t most, std::vector<std::int32_t>& found) const {
    return nodes_.empty() || collect_from(0, meets, most, found);
  }
  /// Calls `take` with what lies in boxes that `meets` does not refuse, near boxes first.
  template <class Meets, class Take>
  void visit(Vec3 from, const Meets& meets, const Take& take) const {
    if (!nodes_.empty()) visit_from(0, from, meets, take);
  }

 private:
  struct Node {
    Box box;
    std::uint32_t first, count;  ///< of ordered_; count 0: children are the next one and `first`
  };
  void grow(const std::vector<Box>& boxes, std::uint32_t begin, std::uint32_t end);

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
  template <class Meets, class Take>
  void visit_from(std::size_t node, Vec3 from, const Meets& meets, const Take& take) const {
    const Node& n = nodes_[node];
    if (!meets(n.box)) return;
    if (n.count == 0) {
      const bool first_is_near =
          distance2(nodes_[node + 1].box, from) <= distance2(nodes_[n.first].box, from);
      visit_from(first_is_near ? node + 1 : n.first, from, meets, take);
      visit_from(first_is_near ? n.first : node + 1, from, meets, take);
      return;
    }
    for (std::uint32_t i = n.first; i < n.first + n.count; ++i)
      take(static_cast<std::size_t>(ordered_[i]));
  }
  static double distance2(const Box& box, Vec3 from) {
    const double x = std::max(0.0, std::abs(box.centre.x - from.x) - box.half.x),
                 y = std::max(0.0, std::abs(box.centre.y - from.y) - box.half.y),
                 z = std::max(0.0, std::abs(box.centre.z - from.z) - box.half.z);
    return x * x + y * y + z * z;
  }

  std::vector<Node> nodes_;
  std::vector<std::int32_t> ordered_;
};

}  // namespace sunload
