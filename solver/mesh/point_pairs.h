// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Pairs of points on surfaces: which of them see each other, 16 at a time.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>

#include "geo/base/vec.h"
#include "solver/surface/ray_caster.h"

namespace sunload {

/// A place on a surface [m] with the unit normal of the side that is looked from.
struct SurfacePoint {
  Vec3 position, normal;
};

/// Up to 16 pairs whose rays are cast together; for one packet only.
class PointPairs {
 public:
  explicit PointPairs(const RayCaster& caster) : caster_(caster) {}

  /// Two points in front of each other's surface.
  struct Facing {
    double cosines_m2;  ///< cosθ_x cosθ_y |y - x|²
    double distance_2;  ///< |y - x|² [m2]
  };
  /// Takes pair l, below 16, unless the points do not face each other, or are nearer than a ray's
  /// offset. `x` is off its surface by that offset already, `y` lies on its own.
  std::optional<Facing> take(std::size_t l, const SurfacePoint& x, const SurfacePoint& y) {
    const Vec3 way = y.position - x.position;
    const double cos_x = dot(x.normal, way), cos_y = -dot(y.normal, way);
    const double distance_2 = dot(way, way);
    const double offset = std::max(caster_.offset_m(), ray_offset_m(x.position));
    if (!(cos_x > 0 && cos_y > 0 && distance_2 > offset * offset)) return {};
    put(origins_, l, x.position);
    put(ways_, l, way + y.normal * offset);
    taken_ |= 1u << l;
    return Facing{cos_x * cos_y, distance_2};
  }

  std::uint64_t count() const { return static_cast<std::uint64_t>(std::popcount(taken_)); }

  /// Casts a ray for every pair and calls visit(l) for those that see each other.
  template <class Visit>
  void for_each_seen(Visit&& visit) const {
    if (taken_ == 0) return;
    for (auto bits = caster_.unoccluded_up_to(origins_, ways_, taken_); bits != 0; bits &= bits - 1)
      visit(static_cast<std::size_t>(std::countr_zero(bits)));
  }

 private:
  const RayCaster& caster_;
  Packet origins_{}, ways_{};
  std::uint32_t taken_ = 0;
};

}  // namespace sunload
