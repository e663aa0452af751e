// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Which of an object's polygons a point lies on: finds the surface that a patch was cut from.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "geo/base/vec.h"

namespace sunload {

/// Rings of one polygon, outer first, without repeated ends.
using PolygonRings = std::vector<std::vector<Vec3>>;

/// The polygons of one object, by cells of a grid over their plan.
class PolygonMatch {
 public:
  explicit PolygonMatch(std::vector<PolygonRings> polygons);

  /// The polygon that holds `point` of a face with that unit normal (of either sign): the nearest
  /// plane, within `tolerance_m` and as much as the polygon itself is out of plane.
  std::optional<std::size_t> polygon_at(Vec3 point, Vec3 normal) const;

  /// Repairs move vertices by less than this, and readers round to it.
  static constexpr double tolerance_m = 0.01;

 private:
  struct Polygon {
    PolygonRings rings;
    Vec3 normal, middle;
    double out_of_plane = 0;
    int drop = 2;  ///< axis along which it is seen largest
  };
  std::size_t cell(double x, double y) const;
  bool holds(const Polygon& polygon, Vec3 point) const;

  std::vector<Polygon> polygons_;
  double low_x_ = 0, low_y_ = 0, step_x_ = 1, step_y_ = 1;
  std::size_t side_ = 1;
  std::vector<std::vector<std::size_t>> cells_;
};

}  // namespace sunload
