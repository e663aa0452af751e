// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Land in the holes of terrain, as their rims tell it.
#pragma once

#include <optional>
#include <vector>

#include "geo/mesh/box_tree.h"
#include "geo/mesh/land.h"

namespace sunload {

/// Between what rims of terrain lie around a place.
class RimLand {
 public:
  /// `rims` must outlive it.
  explicit RimLand(const std::vector<Segment>& rims);

  /// Height at a place that has a rim within some metres (of a hole that was cut out for a house,
  /// not of open land), and rims in most of eight directions: their mean, weighed by the inverse of
  /// the distance, which goes on with planes as they are. Nothing elsewhere.
  std::optional<double> height_at(double x, double y) const;

 private:
  struct Met {
    double distance, z;
  };
  std::optional<Met> first_met(double x, double y, double along_x, double along_y) const;

  const std::vector<Segment>& rims_;
  BoxTree tree_;
};

}  // namespace sunload
