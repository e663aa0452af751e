// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Lines that are looked for by their place in plan.
#pragma once

#include <vector>

#include "geo/mesh/box_tree.h"
#include "geo/mesh/land.h"

namespace sunload {

/// The point of a line that is nearest in plan: how far it is, where along the line and how high.
struct NearestOnLine {
  double distance, along, z;
};
NearestOnLine nearest_in_plan(const Segment& line, double x, double y);

/// Of their boxes in plan.
BoxTree tree_in_plan(const std::vector<Segment>& lines);

/// Finds lines by a tree of their boxes in plan.
class PlanLines {
 public:
  /// `lines` must outlive it.
  explicit PlanLines(const std::vector<Segment>& lines);

  /// Calls `visit` with the nearest point of every line no farther away in plan than that, in no
  /// particular order.
  template <class Visit>
  void visit_within(double x, double y, double distance_m, const Visit& visit) const {
    tree_.visit_meeting(upright(widened({{x, y, 0}, {x, y, 0}}, distance_m)), [&](std::size_t i) {
      const NearestOnLine found = nearest_in_plan(lines_[i], x, y);
      if (found.distance <= distance_m) visit(found);
    });
  }
  bool any_within(double x, double y, double distance_m) const;

 private:
  const std::vector<Segment>& lines_;
  BoxTree tree_;
};

}  // namespace sunload
