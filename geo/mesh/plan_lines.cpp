// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/plan_lines.h"

#include <algorithm>
#include <cmath>

namespace sunload {

BoxTree tree_in_plan(const std::vector<Segment>& lines) {
  std::vector<Box> boxes;
  boxes.reserve(lines.size());
  for (const auto& [a, b] : lines) boxes.push_back(in_plan(box_around({a, b})));
  return BoxTree(std::move(boxes));
}

NearestOnLine nearest_in_plan(const Segment& line, double x, double y) {
  const auto& [a, b] = line;
  const double ex = b.x - a.x, ey = b.y - a.y, length2 = ex * ex + ey * ey;
  const double s =
      length2 > 0 ? std::clamp(((x - a.x) * ex + (y - a.y) * ey) / length2, 0.0, 1.0) : 0;
  return {std::hypot(x - a.x - s * ex, y - a.y - s * ey), s, a.z + s * (b.z - a.z)};
}

PlanLines::PlanLines(const std::vector<Segment>& lines)
    : lines_(lines), tree_(tree_in_plan(lines)) {}

bool PlanLines::any_within(double x, double y, double distance_m) const {
  bool any = false;
  visit_within(x, y, distance_m, [&](const NearestOnLine&) { any = true; });
  return any;
}

}  // namespace sunload
