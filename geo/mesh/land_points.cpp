// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/land_points.h"

#include <algorithm>
#include <cmath>

#include "geo/mesh/plan_lines.h"

namespace sunload {

namespace {

double mean_length(const std::vector<Segment>& lines) {
  double sum = 0;
  for (const auto& [a, b] : lines) sum += std::hypot(b.x - a.x, b.y - a.y);
  return sum / static_cast<double>(lines.size());
}

class QuadTree {
 public:
  QuadTree(const LandLines& lines, const Box& rectangle)
      : rectangle_(rectangle),
        finest_(std::max(finest_land_m, mean_length(lines.feet))),
        feet_(lines.feet),
        rims_(lines.rims) {}

  std::vector<Vec3> run() {
    const Vec3 size = 2 * half_of(rectangle_), middle = centre_of(rectangle_);
    split({middle.x, middle.y, 0}, std::max(size.x, size.y));
    return std::move(points_);
  }

 private:
  void split(Vec3 middle, double side) {
    const Vec3 off = middle - centre_of(rectangle_), half = half_of(rectangle_);
    if (std::abs(off.x) > half.x + side / 2 || std::abs(off.y) > half.y + side / 2) return;
    // None in a strip would be open that is wider than half of it: land of needles.
    const bool is_wide = side >= std::min(half.x, half.y);
    if (side / 2 >= finest_ && (is_wide || has_lines_within(middle, side))) {
      for (const double dx : {-0.25, 0.25})
        for (const double dy : {-0.25, 0.25}) split(middle + Vec3{dx, dy, 0} * side, side / 2);
    } else if (is_open(middle, side / 2)) {
      points_.push_back(middle);
    }
  }
  bool has_lines_within(Vec3 p, double distance_m) const {
    return feet_.any_within(p.x, p.y, distance_m) || rims_.any_within(p.x, p.y, distance_m);
  }
  /// So far from all lines and from the border.
  bool is_open(Vec3 p, double distance_m) const {
    const Vec3 off = p - centre_of(rectangle_), half = half_of(rectangle_);
    return std::abs(off.x) < half.x - distance_m && std::abs(off.y) < half.y - distance_m &&
           !has_lines_within(p, distance_m);
  }

  Box rectangle_;
  double finest_;
  PlanLines feet_, rims_;
  std::vector<Vec3> points_;
};

}  // namespace

std::vector<Vec3> open_land_points(const LandLines& lines, const Box& rectangle) {
  if (lines.feet.empty()) return {};
  return QuadTree(lines, rectangle).run();
}

}  // namespace sunload
