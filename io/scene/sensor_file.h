// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Sensor files: points with normals, one a row.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geo/base/vec.h"

namespace sunload {

/// Where a sensor looks, as of a panel: from level, looking up (0), by way of upright (90), to
/// looking down (180); clockwise from true north.
struct Tilted {
  double tilt_deg = 0, azimuth_deg = 0;
};

/// A sensor as written: absolute, in the frame of the scene (metres, z up).
struct SensorPoint {
  Vec3 position, normal;              ///< the normal need not be of unit length
  std::optional<Tilted> tilted = {};  ///< in place of the normal, whatever north of the scene is
};

/// The least length that a normal may have: shorter ones are taken for zero.
inline constexpr double shortest_normal = 1e-9;

/// Reads a text table x y z nx ny nz. Fields are divided by commas, semicolons, tabs or
/// blanks, so that CSV and the .pts files of Radiance (rtrace, Ladybug, Honeybee) both
/// serve; # begins a comment, empty lines are skipped. A first row that is no numbers is a
/// header, which names these six columns, in any order and among others; without one,
/// every row is six numbers. Decimal commas are refused. Throws InputError with file:line for every
/// row that is wrong.
std::vector<SensorPoint> read_sensor_file(const std::string& path);

}  // namespace sunload
