// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// From which side a picture looks, where nobody says so.
#pragma once

#include <optional>

#include "geo/base/units.h"
#include "geo/base/vec.h"
#include "io/result/reader.h"

namespace sunload {

/// Elevation of the overview: roofs and walls are both well seen.
inline constexpr double overview_elevation_deg = 35;

/// Azimuth, clockwise from true north, of the scene's +y axis: the turn between
/// the sun's azimuth and its direction in the scene, at the lowest sun. A comparison, which has no
/// sun, says it.
double scene_north_deg(const ResultReader& result);
/// Unit vector of the scene towards a compass direction.
Vec3 scene_direction(Horizontal compass, double north_deg);
/// Of north, east, south and west the side that light comes from, and of the sides beside it west
/// for the former and the latter (the afternoon's); of a morning or an evening the one that gets
/// more of it.
Vec3 overview_direction(const ResultReader& result, double north_deg);

/// The side to which surfaces look on the whole, by their normals times areas; none where they
/// look all ways, or up.
std::optional<Vec3> side_of(Vec3 normal_sum, double area);
/// The same of the place that a map is of.
std::optional<Vec3> side_of_mapped_place(const ResultReader& result);

}  // namespace sunload
