// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The smallest convex polygon about some points across the light.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "solver/sight/view_polygon.h"

namespace sunload {

/// Corners counter-clockwise, in `room`, none on a line between its neighbours; fewer than three of
/// points in one line. Andrew (1979), Another efficient algorithm for convex hulls in two
/// dimensions.
inline std::span<const ViewCorner> convex_hull(std::span<const ViewCorner> points,
                                               std::vector<ViewCorner>& room) {
  const std::size_t n = points.size();
  room.assign(points.begin(), points.end());
  std::sort(room.begin(), room.end(), [](const ViewCorner& a, const ViewCorner& b) {
    return a.x != b.x ? a.x < b.x : a.y < b.y;
  });
  room.resize(3 * n + 1);
  ViewCorner* const hull = room.data() + n;
  std::size_t size = 0;
  const auto add = [&](const ViewCorner& p, std::size_t kept) {
    const auto turns_left = [&](const ViewCorner& a, const ViewCorner& b) {
      return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) > 0;
    };
    while (size > kept && !turns_left(hull[size - 2], hull[size - 1])) --size;
    hull[size++] = p;
  };
  for (std::size_t i = 0; i < n; ++i) add(room[i], 1);
  const std::size_t lower = size;
  for (std::size_t i = n; i > 1; --i) add(room[i - 2], lower);
  return {hull, size > 0 ? size - 1 : 0};  // the first has come again
}

}  // namespace sunload
