// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of a polygon that lies in none of the polygons that shade it.
///
/// Sutherland & Hodgman (1974), Reentrant polygon clipping; Weiler & Atherton (1977), Hidden
/// surface removal using polygon area sorting. For shadows of buildings first Groth & Lokmanhekim
/// (1969), Shadow: a new technique for the calculation of shadow shapes and areas by digital
/// computer.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "solver/sight/view_polygon.h"

namespace sunload {

/// The order in which shades, polygons of faces, are taken away, and so rounded: one in which no
/// other sun has a part. The largest first, which leaves least to cut.
struct LargestFirst {
  template <class Shade>
  bool operator()(const Shade* a, const Shade* b) const {
    return a->area > b->area || (a->area == b->area && a->face < b->face);
  }
};

class LitArea {
 public:
  /// Share of its area, exact but for rounding. What many thin shades cut into too many pieces is
  /// halved, and the halves again; nothing where that does not help.
  std::optional<double> share(const ViewPolygon& polygon,
                              std::span<const ViewPolygon* const> shades);
  /// Convex polygons that make up that part of it, as exact; false where they are too many, the
  /// polygon halved and its halves again.
  bool parts(const ViewPolygon& polygon, std::span<const ViewPolygon* const> shades,
             std::vector<ViewPolygon>& lit);

 private:
  using Shades = std::span<const ViewPolygon* const>;
  /// The area that shades leave of a polygon, cut by one after the other.
  std::optional<double> lit_together(const ViewPolygon& polygon, Shades shades);
  /// The same, half by half; `halvings` were made before.
  std::optional<double> lit_of_halves(const ViewPolygon& polygon, Shades shades,
                                      std::size_t halvings);
  bool add_parts(const ViewPolygon& polygon, Shades shades, std::size_t halvings,
                 std::vector<ViewPolygon>& lit);
  bool take_away(const ViewPolygon& shade);
  bool split(const ViewPolygon& piece, const ViewPolygon& shade);

  /// Halves a polygon, unless it has been halved too often or too many parts were looked at.
  bool may_halve(const ViewPolygon& polygon, std::size_t halvings, ViewPolygon& first,
                 ViewPolygon& second);

  double negligible_ = 0;       ///< area of what is rounding
  std::size_t parts_left_ = 0;  ///< that may be looked at
  std::vector<ViewPolygon> left_, next_;
  static constexpr std::size_t most_halvings = 12, most_parts = 64;
  std::array<std::vector<const ViewPolygon*>, most_halvings> of_half_;  ///< by halvings before it
};

}  // namespace sunload
