// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/lit_area.h"

#include <algorithm>

namespace sunload {

namespace {

/// Beyond, rays cost less.
constexpr std::size_t most_pieces = 64;
/// Of the polygon's area: less is rounding.
constexpr double least_share = 1e-12;

using Distances = std::array<double, ViewPolygon::most>;

enum class Side { within, beyond, both };

/// On which side of a line the corners lie, and how far beyond it.
Side measure(const ViewPolygon& polygon, const ViewLine& line, Distances& beyond) {
  bool any_within = false, any_beyond = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    beyond[i] = line.beyond(polygon[i]);
    any_within = any_within || beyond[i] < 0;
    any_beyond = any_beyond || beyond[i] > 0;
  }
  return any_beyond ? any_within ? Side::both : Side::beyond : Side::within;
}

/// The two parts of a polygon; false: one of them has too many corners.
bool cut(const ViewPolygon& polygon, const Distances& beyond, ViewPolygon& within,
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

ViewLine edge(const ViewPolygon& polygon, std::size_t k) {
  return line_through(polygon[k], polygon[k + 1 < polygon.size() ? k + 1 : 0]);
}

/// The area of what of a polygon lies in a shade; below 0: it has too many corners.
double area_within(ViewPolygon polygon, const ViewPolygon& shade) {
  Distances beyond;
  ViewPolygon within, outside;
  for (std::size_t k = 0; k < shade.size(); ++k) {
    const Side side = measure(polygon, edge(shade, k), beyond);
    if (side == Side::beyond) return 0;
    if (side == Side::within) continue;
    if (!cut(polygon, beyond, within, outside)) return -1;
    polygon = within;
  }
  return polygon.area();
}

}  // namespace

std::optional<double> LitArea::share(const ViewPolygon& polygon,
                                     std::span<const ViewPolygon* const> shades) {
  const double area = polygon.area();
  negligible_ = least_share * area;
  left_.assign(1, polygon);
  if (shades.empty()) return 1;
  for (const ViewPolygon* shade : shades.first(shades.size() - 1))
    if (!take_away(*shade)) return {};
  double lit = 0;
  for (const ViewPolygon& piece : left_) {
    const double shaded = area_within(piece, *shades.back());
    if (shaded < 0) return {};
    lit += piece.area() - shaded;
  }
  const double share = lit / area;
  return share < least_share ? 0 : share > 1 - least_share ? 1 : share;
}

bool LitArea::take_away(const ViewPolygon& shade) {
  next_.clear();
  for (const ViewPolygon& piece : left_)
    if (!split(piece, shade)) return false;
  left_.swap(next_);
  return left_.size() <= most_pieces;
}

/// Puts what of a piece lies outside of the shade into next_; false: it has too many corners.
bool LitArea::split(const ViewPolygon& piece, const ViewPolygon& shade) {
  const std::size_t before = next_.size();
  ViewPolygon rest = piece, within, outside;
  Distances beyond;
  for (std::size_t k = 0; k < shade.size(); ++k) {
    const Side side = measure(rest, edge(shade, k), beyond);
    if (side == Side::within) continue;
    if (side == Side::beyond) {
      // All of the piece is outside: what has been cut off of it belongs to it.
      next_.resize(before);
      next_.push_back(piece);
      return true;
    }
    if (!cut(rest, beyond, within, outside)) return false;
    if (outside.area() > negligible_) next_.push_back(outside);
    rest = within;
  }
  return true;  // what is left is shaded
}

}  // namespace sunload
