// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A triangle as a point sees it, and directions uniform within it.
#pragma once

#include "geo/base/vec.h"

namespace sunload {

class SphericalTriangle {
 public:
  /// Corners relative to the point, which lies outside of the triangle; either order.
  SphericalTriangle(Vec3 a, Vec3 b, Vec3 c);

  /// [sr], within a rounding of the corners' directions also where it is tiny or a half space. Van
  /// Oosterom & Strackee (1983), The solid angle of a plane triangle, eq. 8.
  double solid_angle() const { return solid_angle_; }
  /// Unit direction of the point (u, v) of the unit square, with density 1 / solid angle. Loses
  /// digits where that is below some 1e-6. Arvo (1995), Stratified sampling of spherical triangles.
  Vec3 sample(double u, double v) const;

 private:
  Vec3 a_, b_, towards_c_;  ///< unit; the last one across a, in the plane of a and c
  double cos_c_ = 0;        ///< of the arc from a to b
  double angle_ = 0, sin_angle_ = 0, cos_angle_ = 0;  ///< at a
  double solid_angle_ = 0;
};

}  // namespace sunload
