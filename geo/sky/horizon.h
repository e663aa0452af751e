// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Hills around a site: the line that hides the low sky.
#pragma once

#include <vector>

#include "geo/base/units.h"
#include "geo/base/vec.h"

namespace sunload {

class SkyGrid;

/// Elevation of the horizon line by azimuth (clockwise from true north), linear between its
/// points and across north. Without points the horizon is open: 0° all around. The line is that
/// of far hills: all of the scene sees the same one.
class Horizon {
 public:
  Horizon() = default;
  /// Points in any order; azimuths are wrapped, elevations in [0, 90), the same point may come
  /// twice. Throws InputError (without place) for values out of range and for two elevations at
  /// one azimuth.
  explicit Horizon(std::vector<Horizontal> points);

  bool is_open() const { return points_.empty(); }
  double elevation_deg(double azimuth_deg) const;
  /// Whether something at this place stands above the line.
  bool is_above(Horizontal place) const {
    return place.elevation_deg > elevation_deg(place.azimuth_deg);
  }
  /// By azimuth in [0, 360), ascending.
  const std::vector<Horizontal>& points() const { return points_; }

 private:
  std::vector<Horizontal> points_;
};

/// Which share of each cell of a grid in scene axes stands above the line; empty where the
/// horizon is open. Counted on 8 × 8 points of every cell.
std::vector<double> open_shares(const SkyGrid& grid, const Horizon& horizon,
                                const Rotation& scene_from_enu);

}  // namespace sunload
