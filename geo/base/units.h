// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Numbers with a unit: angles are radians unless a name ends in `_deg`.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "geo/base/vec.h"

namespace sunload {

inline constexpr double pi = std::numbers::pi;
inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double radians_per_degree = pi / 180;
inline constexpr double degrees_per_radian = 180 / pi;
inline constexpr double seconds_per_minute = 60;
inline constexpr double seconds_per_hour = 3600;
inline constexpr double seconds_per_day = 86400;
inline constexpr double degrees_of_sun_per_hour = 15;  ///< about the axis: 360 in a mean solar day
inline constexpr double joules_per_kwh = 3.6e6;

constexpr double radians(double angle_deg) { return angle_deg * radians_per_degree; }
constexpr double degrees(double angle) { return angle * degrees_per_radian; }

/// `angle_deg` brought to [0, 360).
inline double wrapped_deg(double angle_deg) {
  const double wrapped = std::fmod(angle_deg, 360.0);
  const double positive = wrapped < 0 ? wrapped + 360.0 : wrapped;
  return positive < 360.0 ? positive : 0.0;
}

/// A direction seen from the ground: azimuth clockwise from north in
/// [0, 360), elevation above the horizon in [-90, 90]. Declared here once.
struct Horizontal {
  double azimuth_deg = 0;
  double elevation_deg = 0;
};

/// Unit vector (x east, y north, z up) of a horizontal direction.
inline Vec3 enu_direction(Horizontal h) {
  const double azimuth = radians(h.azimuth_deg), elevation = radians(h.elevation_deg);
  return {std::cos(elevation) * std::sin(azimuth), std::cos(elevation) * std::cos(azimuth),
          std::sin(elevation)};
}

/// Inverse of `enu_direction`; `enu` need not be of unit length.
inline Horizontal horizontal(Vec3 enu) {
  return {wrapped_deg(degrees(std::atan2(enu.x, enu.y))),
          degrees(std::atan2(enu.z, std::hypot(enu.x, enu.y)))};
}

}  // namespace sunload
