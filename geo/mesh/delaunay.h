// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// One polygon with holes → triangles, by CGAL's constrained Delaunay triangulation.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "geo/base/vec.h"

namespace sunload {

using Ring = std::vector<std::int32_t>;  ///< vertices, no corner twice in a row

/// Twice the area vector of a ring (Newell; Sutherland, Sproull, Schumacker 1974).
Vec3 newell(const std::vector<Vec3>& vertices, const Ring& ring);

/// A point of the drawing.
struct Point2 {
  double u, v;
};

/// The plane of a polygon and the view along the axis nearest to its normal.
class Plane {
 public:
  Plane(Vec3 through, Vec3 unit_normal) : through_(through), normal_(unit_normal) {
    const double x = std::abs(normal_.x), y = std::abs(normal_.y), z = std::abs(normal_.z);
    axis_ = z >= x && z >= y ? 2 : (x >= y ? 0 : 1);
    is_mirrored_ = component(normal_, axis_) < 0;
  }
  /// The same for a polygon and its back, so that both get the same triangles.
  Point2 seen(Vec3 p) const {
    return {component(p, (axis_ + 1) % 3), component(p, (axis_ + 2) % 3)};
  }
  /// True where counter-clockwise on paper is clockwise seen against the normal.
  bool is_mirrored() const { return is_mirrored_; }
  Vec3 lifted(Point2 q) const {
    std::array<double, 3> p{};
    p[static_cast<std::size_t>((axis_ + 1) % 3)] = q.u;
    p[static_cast<std::size_t>((axis_ + 2) % 3)] = q.v;
    p[static_cast<std::size_t>(axis_)] = component(through_, axis_);
    const Vec3 start{p[0], p[1], p[2]};
    p[static_cast<std::size_t>(axis_)] -= offset(start) / component(normal_, axis_);
    return {p[0], p[1], p[2]};
  }
  double offset(Vec3 p) const { return dot(p - through_, normal_); }
  Vec3 normal() const { return normal_; }

 private:
  Vec3 through_, normal_;
  int axis_ = 2;
  bool is_mirrored_ = false;
};

/// A polygon with holes, and the plane that it is seen in.
struct PlanePolygon {
  std::vector<Ring> rings;  ///< [0] is the outer one
  Plane plane;
  double area2 = 0;  ///< doubled: outer ring less holes
};

/// The triangles of one polygon.
struct PolygonTriangles {
  /// How well the triangles fill the polygon.
  enum class Outcome {
    exact,     ///< the area is that of the polygon
    crossing,  ///< rings cross: corners may be new, the area is what it came to
    failed     ///< nothing was made
  };
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< facing as the plane's normal
  Outcome outcome = Outcome::exact;
};

/// Appends corners to `vertices` where rings cross. The inside is found by
/// counting ring edges from the outside, an edge walked an even number of times
/// not counting; where that does not give the polygon's area, by asking for
/// each triangle whether it is inside the outer ring and outside all holes.
/// Never throws for bad geometry; equal polygons get equal triangles, and so do
/// a polygon and its back.
PolygonTriangles delaunay_triangles(std::vector<Vec3>& vertices, const PlanePolygon& polygon);

}  // namespace sunload
