// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/point_tree.h"

#include <algorithm>
#include <array>
#include <utility>

#include "geo/mesh/box_tree.h"

namespace sunload {

namespace {

constexpr std::uint32_t points_per_leaf = 8;
/// Halving 32-bit numbers of points ends after as many levels.
constexpr std::size_t most_levels = 32;

int longest_axis(const Box& box) {
  const Vec3 size = box.high - box.low;
  return size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
}

/// True where some point start + s·edge with s in [0, 1] lies in the box, widened by `margin`.
bool meets(const Box& box, Vec3 start, Vec3 edge, double margin) {
  double s0 = 0, s1 = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = component(edge, axis);
    const double low = component(box.low, axis) - component(start, axis) - margin;
    const double high = component(box.high, axis) - component(start, axis) + margin;
    if (d == 0) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    s0 = std::max(s0, (d > 0 ? low : high) / d);
    s1 = std::min(s1, (d > 0 ? high : low) / d);
    if (s0 > s1) return false;
  }
  return true;
}

}  // namespace

PointTree::PointTree(const std::vector<Vec3>& vertices, std::vector<std::int32_t> points)
    : vertices_(vertices), points_(std::move(points)) {
  if (!points_.empty()) build(0, static_cast<std::uint32_t>(points_.size()));
}

std::uint32_t PointTree::build(std::uint32_t first, std::uint32_t last) {
  const auto begin = points_.begin() + first, end = points_.begin() + last;
  Box box{at(*begin), at(*begin)};
  for (auto v = begin; v != end; ++v) {
    const Vec3 p = at(*v);
    include(box, p);
  }
  const auto node = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({box, first, last, 0});
  if (last - first <= points_per_leaf) return node;
  const int axis = longest_axis(box);
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(begin, points_.begin() + middle, end, [&](std::int32_t a, std::int32_t b) {
    return std::pair(component(at(a), axis), a) < std::pair(component(at(b), axis), b);
  });
  build(first, middle);
  const auto second = build(middle, last);
  nodes_[node].second_child = second;
  return node;
}

PointTree::Found PointTree::near_segment(Vec3 start, Vec3 end, double distance) const {
  Found found;
  if (nodes_.empty()) return found;
  const Vec3 edge = end - start;
  // The second distance is more than all that rounding can take away.
  const double margin = 2 * distance;
  std::array<std::uint32_t, most_levels + 1> stack{0};
  for (std::size_t waiting = 1; waiting > 0;) {
    const auto n = stack[--waiting];
    const Node& node = nodes_[n];
    ++found.looks;
    if (!meets(node.box, start, edge, margin)) continue;
    if (node.second_child != 0) {
      stack[waiting++] = node.second_child;
      stack[waiting++] = n + 1;
      continue;
    }
    found.looks += node.last - node.first;
    found.points.insert(found.points.end(), points_.begin() + node.first,
                        points_.begin() + node.last);
  }
  return found;
}

}  // namespace sunload
