// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Small flat polygons in space: what of them lies before a plane, and how they look along light.
/// Sutherland & Hodgman (1974), Reentrant polygon clipping.
#pragma once

#include <array>
#include <span>

#include "solver/sight/sun_clusters.h"
#include "solver/sight/view_polygon.h"

namespace sunload {

/// What lies before a plane.
struct HalfSpace {
  Vec3 normal;
  double offset;  ///< normal · any point of the plane
  double above(Vec3 p) const { return dot(normal, p) - offset; }
};

/// Up to `most` corners, held in place, convex.
class FlatPolygon {
 public:
  static constexpr std::size_t most = ViewPolygon::most;
  explicit FlatPolygon(std::span<const Vec3> corners);
  std::span<const Vec3> corners() const { return std::span(corner_).first(count_); }

  enum class Kept { none, all, part, too_many_corners };
  /// Leaves what lies before a plane; all where it would have too many corners.
  Kept keep_before(const HalfSpace& plane);
  /// As it is seen across the light, counter-clockwise, no two corners in one place.
  ViewPolygon seen(const ViewFrame& frame) const;

 private:
  std::array<Vec3, most> corner_;
  std::size_t count_;
};

}  // namespace sunload
