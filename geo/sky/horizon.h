// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Hills around a site: the line that hides the low sky.
#pragma once

#include <functional>
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

/// Which share of a piece of the sky stands above the line. `place` takes the unit square
/// (coordinates in [0, 1]) to the piece, equal areas to equal solid angles.
///
/// The height above the line is taken as linear between 41 places of the piece, and what is
/// above zero of that counts exactly: also of a level line along one side.
double open_share(const Horizon& horizon, const std::function<Horizontal(double, double)>& place);

/// The same of each cell of a grid in scene axes; empty where the horizon is open.
std::vector<double> open_shares(const SkyGrid& grid, const Horizon& horizon,
                                const Rotation& scene_from_enu);

}  // namespace sunload
