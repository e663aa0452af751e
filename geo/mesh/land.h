// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Land through given lines: a constrained Delaunay triangulation in plan (CGAL).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geo/base/vec.h"

namespace sunload {

using Segment = std::array<Vec3, 2>;

/// Ends nearer than this in plan are one point of the land, and points this near to a line are on
/// it: the party walls of a terrace, each written by itself.
inline constexpr double land_snap_m = 0.01;

/// Lines that land goes through, heights included [m, relative to the mesh's origin].
struct LandLines {
  std::vector<Segment> rims;              ///< of terrain: the land has their heights
  std::vector<Segment> feet;              ///< elsewhere it is nowhere lower than these
  std::vector<std::int32_t> foot_body;    ///< whose each of them is
  double x0 = 0, x1 = 0, y0 = 0, y1 = 0;  ///< the rectangle that it fills
};

/// Triangles of land over the whole rectangle.
struct Land {
  std::vector<Vec3> points;
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< counter-clockwise seen from above
  double steepest_beyond = 0;  ///< slope by which it goes on beyond the lines, at most: a tangent
};

/// Triangles between all lines, which are edges of theirs, with points on open land so that none is
/// a needle (geo/mesh/land_points): their heights are interpolated between the lines. Beyond the
/// convex hull of the lines, up to the rectangle around them, the land goes on from the hull's
/// nearest point by the slope of the lines around (geo/mesh/land_slope), for as far as that
/// reaches, but not farther than the lines extend; then level. Equal lines give equal bits. Throws
/// InputError where lines cross without end.
Land triangulate_land(const LandLines& lines);

}  // namespace sunload
