// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/box_tree.h"

#include <algorithm>
#include <numeric>

namespace sunload {

namespace {

constexpr std::uint32_t leaf_size = 4;
constexpr double any_height = 1e300;  // as an empty Box begins: sums of two are finite

}  // namespace

Box box_of(const Mesh& mesh, std::size_t triangle) {
  return box_around({mesh.corner(triangle, 0), mesh.corner(triangle, 1), mesh.corner(triangle, 2)});
}

void include(Box& box, Vec3 p) {
  box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
  box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
}

Box box_around(std::initializer_list<Vec3> points) {
  Box box;
  for (const Vec3 p : points) include(box, p);
  return box;
}

Box widened(Box box, double by) {
  const Vec3 margin{by, by, by};
  return {box.low - margin, box.high + margin};
}

bool meet(const Box& a, const Box& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
         a.low.z <= b.high.z && b.low.z <= a.high.z;
}

double shared_plan_m2(const Box& a, const Box& b) {
  const double x = std::min(a.high.x, b.high.x) - std::max(a.low.x, b.low.x);
  const double y = std::min(a.high.y, b.high.y) - std::max(a.low.y, b.low.y);
  return std::max(0.0, x) * std::max(0.0, y);
}

Box upright(Box box) {
  box.low.z = -any_height, box.high.z = any_height;
  return box;
}

Box in_plan(Box box) {
  box.low.z = box.high.z = 0;
  return box;
}

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  if (!boxes_.empty()) build(0, static_cast<std::uint32_t>(boxes_.size()));
}

std::uint32_t BoxTree::build(std::uint32_t first, std::uint32_t last) {
  const auto n = static_cast<std::uint32_t>(nodes_.size());
  Box box;
  for (std::uint32_t i = first; i < last; ++i) {
    include(box, boxes_[order_[i]].low);
    include(box, boxes_[order_[i]].high);
  }
  nodes_.push_back({box, first, last, 0});
  if (last - first <= leaf_size) return n;
  const Vec3 size = box.high - box.low;
  const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
  const auto middle = [&](std::uint32_t i) {
    return component(boxes_[i].low, axis) + component(boxes_[i].high, axis);
  };
  const std::uint32_t half = first + (last - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + half, order_.begin() + last,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double of_a = middle(a), of_b = middle(b);
                     return of_a != of_b ? of_a < of_b : a < b;
                   });
  build(first, half);
  const std::uint32_t second = build(half, last);
  nodes_[n].second_child = second;
  return n;
}

}  // namespace sunload
