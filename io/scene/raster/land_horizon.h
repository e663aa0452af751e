// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The line of hills that a place sees, from a raster of the land.
#pragma once

#include <string>
#include <vector>

#include "geo/base/units.h"
#include "io/scene/raster/raster.h"

namespace sunload {

/// Where one stands, and of which land.
struct LandView {
  Vec3 place;                 ///< on the raster's map [m]; z is not used
  double grid_north_deg = 0;  ///< azimuth of the map's +y axis there, clockwise from true north
  double above_m = 2;         ///< of the eye, above the land of the place
  double from_m = 0;          ///< land nearer than this is the scene's own
  double to_m = 50e3;         ///< how far is looked
  double step_deg = 1;        ///< between two azimuths
};

/// The line of hills, azimuth by azimuth.
struct LandHorizon {
  std::vector<Horizontal> points;   ///< by azimuth from north; what lies below the eye is 0
  std::vector<double> distance_m;   ///< of what is the line there; 0: nothing rises above 0°
  std::vector<double> looked_to_m;  ///< where the raster ends, or `to_m`
  double land_m = 0;                ///< height of the land at the place
};

/// What the land hides, with the Earth's curvature and the bending of light along it: at the
/// distance d heights fall by (1 - k) d² / 2R, with R = 6371 km and k = 0.13 (Gauss' coefficient
/// of terrestrial refraction; Torge & Müller 2012, Geodesy, 5.1.2). Heights are bilinear between
/// the middles of cells, and the highest of each ray is exact: where it crosses lines between
/// middles, or where its profile has its own top between two of them. `unit_m`: of one unit of the
/// raster. Cost: 360 / step · distance / cell. Throws InputError, which names `path`, where the
/// place lies outside of the raster or on cells without data.
LandHorizon land_horizon(const std::string& path, const Raster& raster, double unit_m,
                         const LandView& view);

}  // namespace sunload
