// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Earth and sun in inertial space: the slow terms of the sun's place (ERFA).
///
/// Internal to geo/: time.h and sun.h are what callers use. IAU 2006/2000A
/// precession and nutation; TT stands for TDB (they differ by 2 ms at most).
#pragma once

#include "geo/base/vec.h"
#include "geo/time/time.h"

namespace sunload {

/// Leap seconds: TAI−UTC [s] at an instant (drifting before 1972, 0 before 1960,
/// the last known value after the library's table).
double tai_minus_utc_s(UnixTime utc);

/// Geocentric apparent sun.
struct ApparentSun {
  Vec3 position_au;  ///< true equator and equinox of date; length: the geometric distance
  double equation_of_origins = 0;  ///< ERA minus Greenwich apparent sidereal time
};

/// Sun as seen from the Earth's centre: light time and annual aberration are
/// applied, diurnal aberration (at most 0.00009°) is not. Within 0.1″ of
/// modern ephemerides for 1900 … 2100, slowly worse outside.
ApparentSun apparent_sun(JulianDate tt);

/// The same in the axes of the celestial intermediate frame of date, whose
/// angle to the Earth's axes is the Earth rotation angle alone [AU].
Vec3 intermediate_sun_au(JulianDate tt);

/// Earth rotation angle [0, 2π).
double earth_rotation_angle(JulianDate ut1);

/// Components of `v` in axes turned by `angle` about z, counter-clockwise.
Vec3 in_axes_turned_about_z(Vec3 v, double angle);

}  // namespace sunload
