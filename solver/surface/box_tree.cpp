// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/surface/box_tree.h"

#include <numeric>
#include <tuple>

namespace sunload {

namespace {

struct Bounds {
  Vec3 low, high;
  explicit Bounds(Vec3 p) : low(p), high(p) {}
  void hold(Vec3 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  int longest_axis() const {
    const Vec3 size = high - low;
    if (size.x >= size.y && size.x >= size.z) return 0;
    return size.y >= size.z ? 1 : 2;
  }
  BoxTree::Box box() const { return {(low + high) * 0.5, (high - low) * 0.5}; }
};

}  // namespace

BoxTree::Box BoxTree::box_about(std::span<const Vec3> points) {
  Bounds bounds(points[0]);
  for (const Vec3 p : points) bounds.hold(p);
  return bounds.box();
}

BoxTree::BoxTree(const std::vector<Box>& boxes) : ordered_(boxes.size()) {
  std::iota(ordered_.begin(), ordered_.end(), 0);
  if (!boxes.empty()) grow(boxes, 0, static_cast<std::uint32_t>(boxes.size()));
}

void BoxTree::grow(const std::vector<Box>& boxes, std::uint32_t begin, std::uint32_t end) {
  constexpr std::uint32_t most_of_leaf = 4;
  const auto of = [&](std::int32_t i) -> const Box& { return boxes[static_cast<std::size_t>(i)]; };
  Bounds all(of(ordered_[begin]).centre), centres(of(ordered_[begin]).centre);
  for (std::uint32_t i = begin; i < end; ++i) {
    const Box& box = of(ordered_[i]);
    all.hold(box.centre - box.half);
    all.hold(box.centre + box.half);
    centres.hold(box.centre);
  }
  const std::size_t node = nodes_.size();
  nodes_.push_back({all.box(), begin, end - begin});
  if (end - begin <= most_of_leaf) return;
  const int axis = centres.longest_axis();
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(ordered_.begin() + begin, ordered_.begin() + middle, ordered_.begin() + end,
                   [&](std::int32_t a, std::int32_t b) {
                     return std::pair(component(of(a).centre, axis), a) <
                            std::pair(component(of(b).centre, axis), b);
                   });
  grow(boxes, begin, middle);
  nodes_[node].first = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].count = 0;
  grow(boxes, middle, end);
}

}  // namespace sunload
