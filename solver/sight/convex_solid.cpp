// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/convex_solid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geo/base/check.h"
#include "geo/mesh/clip.h"

namespace sunload {

namespace {

/// Of the square of the longest extent: less is a line, but for rounding.
constexpr double line_share = 1e-9;

/// Leaves what of a convex polygon does not lie before a plane.
void cut_polygon(std::vector<Vec3>& polygon, const HalfSpace& away) {
  polygon = clipped(polygon, [&](Vec3 p) { return -away.above(p); });
}

}  // namespace

ConvexSolid::ConvexSolid(Vec3 middle, const std::array<Vec3, 3>& axes, Vec3 half) {
  const std::array<double, 3> reach{half.x, half.y, half.z};
  for (std::size_t a = 0; a < 3; ++a)
    for (const double sign : {-1.0, 1.0}) {
      const Vec3 normal = axes[a] * sign, at = middle + normal * reach[a];
      const Vec3 u = axes[(a + 1) % 3] * reach[(a + 1) % 3],
                 v = axes[(a + 2) % 3] * (sign * reach[(a + 2) % 3]);
      sides_.push_back(
          {{normal, dot(normal, at)}, {at - u - v, at + u - v, at + u + v, at - u + v}});
    }
}

bool ConvexSolid::has_within(Vec3 point, double depth_m) const {
  return std::all_of(sides_.begin(), sides_.end(),
                     [&](const Side& side) { return side.beyond.above(point) < -depth_m; });
}

double ConvexSolid::volume() const {
  if (sides_.empty()) return 0;
  const Vec3 from = sides_.front().corners.front();
  double volume = 0;
  for (const Side& side : sides_)
    volume -= side.beyond.above(from) * norm(area_vector2(side.corners)) / 6;
  return volume;
}

void ConvexSolid::cut(const HalfSpace& away) {
  Side section{away, {}};
  double reach = 0;
  for (const Side& side : sides_)
    for (const Vec3& corner : side.corners)
      reach = std::max(reach, norm(corner - sides_.front().corners.front()));
  if (!sides_.empty()) {
    const auto [u, v] = tangents(away.normal);
    const Vec3 near = sides_.front().corners.front(), at = near - away.normal * away.above(near);
    // As wide as to hold all of it.
    for (const auto& [x, y] : {std::pair{-2, -2}, {2, -2}, {2, 2}, {-2, 2}})
      section.corners.push_back(at + u * (x * reach) + v * (y * reach));
  }
  for (Side& side : sides_) {
    cut_polygon(section.corners, side.beyond);
    cut_polygon(side.corners, away);
  }
  sides_.push_back(std::move(section));
  const double least = line_share * reach * reach;
  std::erase_if(sides_,
                [&](const Side& side) { return norm(area_vector2(side.corners)) <= least; });
}

std::vector<Vec3> ConvexSolid::part_within(std::span<const Vec3> polygon, double depth_m) const {
  std::vector<Vec3> part(polygon.begin(), polygon.end());
  for (const Side& side : sides_)
    cut_polygon(part, {side.beyond.normal, side.beyond.offset - depth_m});
  return part;
}

ConvexSolid::Frame ConvexSolid::frame(double apart_m) const {
  Frame frame;
  const auto number_of = [&](Vec3 corner) {
    for (std::size_t i = 0; i < frame.corners.size(); ++i)
      if (norm(frame.corners[i] - corner) < apart_m) return static_cast<std::uint8_t>(i);
    frame.corners.push_back(corner);
    SUNLOAD_EXPECT(frame.corners.size() < 256, "solids have few corners");
    return static_cast<std::uint8_t>(frame.corners.size() - 1);
  };
  for (const Side& side : sides_)
    for (std::size_t k = 0; k < side.corners.size(); ++k) {
      const auto a = number_of(side.corners[k]),
                 b = number_of(side.corners[(k + 1) % side.corners.size()]);
      if (a != b) frame.edges.push_back({std::min(a, b), std::max(a, b)});
    }
  std::sort(frame.edges.begin(), frame.edges.end());
  frame.edges.erase(std::unique(frame.edges.begin(), frame.edges.end()), frame.edges.end());
  return frame;
}

}  // namespace sunload
