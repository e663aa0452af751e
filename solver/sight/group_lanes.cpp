// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/group_lanes.h"

#include <algorithm>
#include <bit>

#include "geo/base/check.h"
#include "geo/base/vector_code.h"

namespace sunload {

namespace {

using Lanes = GroupLanes::Lanes;

SUNLOAD_VECTOR_CODE void take_along(const Lanes& x, const Lanes& y, const Lanes& z, Vec3 axis,
                                    Lanes& __restrict along) {
  for (std::size_t g = 0; g < GroupLanes::most; ++g)
    along[g] = x[g] * axis.x + y[g] * axis.y + z[g] * axis.z;
}

/// Smallest and largest of three.
SUNLOAD_VECTOR_CODE void find_extent(const std::array<Lanes, 3>& of, Lanes& __restrict least,
                                     Lanes& __restrict most) {
  for (std::size_t g = 0; g < GroupLanes::most; ++g) {
    const double a = of[0][g], b = of[1][g], c = of[2][g];
    const double low = a < b ? a : b, high = a < b ? b : a;
    least[g] = low < c ? low : c;
    most[g] = high < c ? c : high;
  }
}

/// By how much boxes reach into another one [m]; below 0: they are apart.
SUNLOAD_VECTOR_CODE void find_common(const GroupLanes::Seen& seen, const ViewBox& box,
                                     Lanes& __restrict common) {
  for (std::size_t g = 0; g < GroupLanes::most; ++g) {
    const double left = seen.x1[g] - box.x0, right = box.x1 - seen.x0[g];
    const double below = seen.y1[g] - box.y0, above = box.y1 - seen.y0[g];
    const double across = left < right ? left : right, along = below < above ? below : above;
    common[g] = across < along ? across : along;
  }
}

}  // namespace

GroupLanes::GroupLanes(const LitShares& shares, std::span<const LitShares::Group> groups) {
  SUNLOAD_EXPECT(groups.size() <= most, "a lane for each group");
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const Vec3 normal = groups[g].normal, lift = normal * shares.offset_m();
    normal_.x[g] = normal.x;
    normal_.y[g] = normal.y;
    normal_.z[g] = normal.z;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto vertex = static_cast<std::size_t>(groups[g].vertices[c]);
      const Vec3 p = shares.hierarchy().vertices()[vertex] + lift;
      corner_[c].x[g] = p.x;
      corner_[c].y[g] = p.y;
      corner_[c].z[g] = p.z;
    }
  }
}

std::array<Vec3, 3> GroupLanes::corners(std::size_t group) const {
  std::array<Vec3, 3> corners;
  for (std::size_t c = 0; c < 3; ++c)
    corners[c] = {corner_[c].x[group], corner_[c].y[group], corner_[c].z[group]};
  return corners;
}

void GroupLanes::see(const ViewFrame& frame, Seen& seen) const {
  std::array<Lanes, 3> x, y;
  for (std::size_t c = 0; c < 3; ++c) {
    take_along(corner_[c].x, corner_[c].y, corner_[c].z, frame.x, x[c]);
    take_along(corner_[c].x, corner_[c].y, corner_[c].z, frame.y, y[c]);
  }
  find_extent(x, seen.x0, seen.x1);
  find_extent(y, seen.y0, seen.y1);
  take_along(normal_.x, normal_.y, normal_.z, frame.to_sun, seen.cos_theta);
}

std::uint32_t GroupLanes::meeting(const Seen& seen, const ViewBox& box, const HalfSpace& before,
                                  double least_cosine) const {
  Lanes common;
  find_common(seen, box, common);
  std::uint32_t meeting = 0;
  for (std::size_t g = 0; g < most; ++g)
    if (common[g] >= 0 && seen.cos_theta[g] > least_cosine) meeting |= 1u << g;
  for (auto left = meeting; left != 0; left &= left - 1) {
    const auto g = static_cast<std::size_t>(std::countr_zero(left));
    const auto is_before = [&](Vec3 corner) { return before.above(corner) > 0; };
    const std::array corners = this->corners(g);
    if (std::none_of(corners.begin(), corners.end(), is_before)) meeting &= ~(1u << g);
  }
  return meeting;
}

}  // namespace sunload
