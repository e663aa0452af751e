// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/flat_polygon.h"

#include <algorithm>
#include <cmath>

#include "geo/base/check.h"

namespace sunload {

namespace {

/// Corners that are nearer to each other are one, which a plane through it has cut in two: the line
/// between them has no direction. A thousand roundings of a coordinate of a kilometre.
constexpr double one_place_m = 1e-9;

}  // namespace

FlatPolygon::FlatPolygon(std::span<const Vec3> corners) : count_(corners.size()) {
  SUNLOAD_EXPECT(count_ <= most, "flat polygons have room for all corners");
  std::copy(corners.begin(), corners.end(), corner_.begin());
}

FlatPolygon::Kept FlatPolygon::keep_before(const HalfSpace& plane) {
  std::array<double, most> above;
  bool any = false, all = true;
  for (std::size_t k = 0; k < count_; ++k) {
    above[k] = plane.above(corner_[k]);
    any = any || above[k] > 0;
    all = all && above[k] > 0;
  }
  if (!any) {
    count_ = 0;
    return Kept::none;
  }
  if (all) return Kept::all;
  const FlatPolygon before = *this;
  count_ = 0;
  std::size_t p = before.count_ - 1;
  for (std::size_t q = 0; q < before.count_; p = q++) {
    if (count_ + 2 > most) {
      *this = before;
      return Kept::too_many_corners;
    }
    const Vec3 a = before.corner_[p], b = before.corner_[q];
    if ((above[p] > 0) != (above[q] > 0))
      corner_[count_++] = a + (b - a) * (above[p] / (above[p] - above[q]));
    if (above[q] > 0) corner_[count_++] = b;
  }
  return Kept::part;
}

ViewPolygon FlatPolygon::seen(const ViewFrame& frame) const {
  ViewPolygon polygon;
  const auto is_apart = [](const ViewCorner& a, const ViewCorner& b) {
    return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)) > one_place_m;
  };
  for (const Vec3& p : corners()) {
    const ViewCorner corner{dot(p, frame.x), dot(p, frame.y)};
    if (polygon.size() == 0 || is_apart(corner, polygon[polygon.size() - 1])) polygon.add(corner);
  }
  while (polygon.size() > 1 && !is_apart(polygon[polygon.size() - 1], polygon[0]))
    polygon.drop_last();
  return polygon.has_area() && polygon.area() < 0 ? polygon.reversed() : polygon;
}

}  // namespace sunload
