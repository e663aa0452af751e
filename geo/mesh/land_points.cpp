// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/land_points.h"

#include <algorithm>
#include <cmath>

namespace sunload {

namespace {

BoxTree tree_of(const std::vector<Segment>& lines) {
  std::vector<Box> boxes;
  boxes.reserve(lines.size());
  for (const auto& [a, b] : lines) boxes.push_back(in_plan(box_around({a, b})));
  return BoxTree(std::move(boxes));
}

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
        from_feet_(lines.feet),
        from_rims_(lines.rims) {}

  std::vector<Vec3> run() {
    const Vec3 size = 2 * half_of(rectangle_), middle = centre_of(rectangle_);
    split({middle.x, middle.y, 0}, std::max(size.x, size.y));
    return std::move(points_);
  }

 private:
  void split(Vec3 middle, double side) {
    const Vec3 off = middle - centre_of(rectangle_), half = half_of(rectangle_);
    if (std::abs(off.x) > half.x + side / 2 || std::abs(off.y) > half.y + side / 2) return;
    if (side / 2 >= finest_ && has_lines_within(middle, side)) {
      for (const double dx : {-0.25, 0.25})
        for (const double dy : {-0.25, 0.25}) split(middle + Vec3{dx, dy, 0} * side, side / 2);
    } else if (is_open(middle, side / 2)) {
      points_.push_back(middle);
    }
  }
  bool has_lines_within(Vec3 p, double distance_m) const {
    return from_feet_.is_within(p.x, p.y, distance_m) || from_rims_.is_within(p.x, p.y, distance_m);
  }
  /// So far from all lines and from the border.
  bool is_open(Vec3 p, double distance_m) const {
    const Vec3 off = p - centre_of(rectangle_), half = half_of(rectangle_);
    return std::abs(off.x) < half.x - distance_m && std::abs(off.y) < half.y - distance_m &&
           !has_lines_within(p, distance_m);
  }

  Box rectangle_;
  double finest_;
  LandDistance from_feet_, from_rims_;
  std::vector<Vec3> points_;
};

}  // namespace

LandDistance::LandDistance(const std::vector<Segment>& lines)
    : lines_(lines), tree_(tree_of(lines)) {}

bool LandDistance::is_within(double x, double y, double distance_m) const {
  bool found = false;
  tree_.visit_meeting(upright(widened({{x, y, 0}, {x, y, 0}}, distance_m)), [&](std::size_t i) {
    if (found) return;
    const auto& [a, b] = lines_[i];
    const double ex = b.x - a.x, ey = b.y - a.y, length2 = ex * ex + ey * ey;
    const double s =
        length2 > 0 ? std::clamp(((x - a.x) * ex + (y - a.y) * ey) / length2, 0.0, 1.0) : 0;
    found = std::hypot(x - a.x - s * ex, y - a.y - s * ey) <= distance_m;
  });
  return found;
}

std::vector<Vec3> open_land_points(const LandLines& lines, const Box& rectangle) {
  if (lines.feet.empty()) return {};
  return QuadTree(lines, rectangle).run();
}

}  // namespace sunload
