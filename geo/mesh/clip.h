// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Convex polygons cut by lines, on paper and in space.
#pragma once

#include <cstddef>
#include <vector>

#include "geo/base/vec.h"
#include "geo/mesh/delaunay.h"

namespace sunload {

inline Vec3 between(Vec3 p, Vec3 q, double s) { return p + s * (q - p); }
inline Point2 between(Point2 p, Point2 q, double s) {
  return {p.u + s * (q.u - p.u), p.v + s * (q.v - p.v)};
}

/// Twice the area of a flat polygon, along its normal.
inline Vec3 area_vector2(const std::vector<Vec3>& polygon) {
  Vec3 sum{0, 0, 0};
  for (std::size_t k = 2; k < polygon.size(); ++k)
    sum += cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
  return sum;
}

/// The part of a convex polygon where `side`, linear in the point, is not below 0
/// (Sutherland and Hodgman 1974, Reentrant polygon clipping).
template <class Point, class Side>
std::vector<Point> clipped(const std::vector<Point>& polygon, const Side& side) {
  std::vector<Point> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point p = polygon[i], q = polygon[(i + 1) % polygon.size()];
    const double of_p = side(p), of_q = side(q);
    if (of_p >= 0) kept.push_back(p);
    if ((of_p > 0 && of_q < 0) || (of_p < 0 && of_q > 0))
      kept.push_back(between(p, q, of_p / (of_p - of_q)));
  }
  return kept;
}

}  // namespace sunload
