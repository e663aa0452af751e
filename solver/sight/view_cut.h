// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Small convex polygons cut by lines and by each other: Sutherland & Hodgman (1974), Reentrant
/// polygon clipping.
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "solver/sight/view_polygon.h"

namespace sunload {

/// Of corners beyond a line.
using ViewDistances = std::array<double, ViewPolygon::most>;

enum class ViewSide { within, beyond, both };

/// On which side of a line the corners lie, and how far beyond it.
inline ViewSide measure(const ViewPolygon& polygon, const ViewLine& line, ViewDistances& beyond) {
  bool any_within = false, any_beyond = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    beyond[i] = line.beyond(polygon[i]);
    any_within = any_within || beyond[i] < 0;
    any_beyond = any_beyond || beyond[i] > 0;
  }
  return any_beyond ? any_within ? ViewSide::both : ViewSide::beyond : ViewSide::within;
}

/// The two parts of a polygon; false: one of them has too many corners.
inline bool cut(const ViewPolygon& polygon, const ViewDistances& beyond, ViewPolygon& within,
                ViewPolygon& outside) {
  within.clear();
  outside.clear();
  std::size_t p = polygon.size() - 1;
  for (std::size_t q = 0; q < polygon.size(); p = q++) {
    if (std::max(within.size(), outside.size()) + 2 > ViewPolygon::most) return false;
    const ViewCorner a = polygon[p], b = polygon[q];
    if ((beyond[p] > 0) != (beyond[q] > 0)) {
      const double t = beyond[p] / (beyond[p] - beyond[q]);
      const ViewCorner at{a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t};
      within.add(at);
      outside.add(at);
    }
    (beyond[q] > 0 ? outside : within).add(b);
  }
  return true;
}

inline ViewLine edge(const ViewPolygon& polygon, std::size_t k) {
  return line_through(polygon[k], polygon[k + 1 < polygon.size() ? k + 1 : 0]);
}

/// Leaves of a polygon what lies in another one, nothing where they are apart; false: it has too
/// many corners.
inline bool keep_within(ViewPolygon& polygon, const ViewPolygon& other) {
  ViewDistances beyond;
  ViewPolygon within, outside;
  for (std::size_t k = 0; k < other.size(); ++k) {
    const ViewSide side = measure(polygon, edge(other, k), beyond);
    if (side == ViewSide::within) continue;
    if (side == ViewSide::beyond) {
      polygon.clear();
      return true;
    }
    if (!cut(polygon, beyond, within, outside)) return false;
    polygon = within;
  }
  return true;
}

/// Whether a polygon has something in common with one of others.
inline bool any_reaches_into(std::span<const ViewPolygon* const> others,
                             const ViewPolygon& polygon) {
  return std::any_of(others.begin(), others.end(), [&](const ViewPolygon* other) {
    ViewPolygon common = polygon;
    return !keep_within(common, *other) || common.has_area();
  });
}

inline ViewBox box_of(const ViewPolygon& polygon) {
  ViewBox box;
  for (std::size_t i = 0; i < polygon.size(); ++i) box.include(polygon[i]);
  return box;
}

}  // namespace sunload
