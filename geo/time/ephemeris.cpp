// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/time/ephemeris.h"

#include <erfa.h>
#include <erfam.h>

#include <cmath>

#include "geo/base/check.h"
#include "geo/base/units.h"

namespace sunload {

namespace {

Vec3 vec3(const double v[3]) { return {v[0], v[1], v[2]}; }

constexpr double light_time_days_per_au = ERFA_AULT / ERFA_DAYSEC;

// Where the sun was when its light left, seen from the Earth now [AU]. The sun moves by 0.02″
// about the barycentre in that time, so a single pass with the geometric distance is exact.
Vec3 sun_when_light_left(const double earth_from_sun[2][3], const double earth[2][3]) {
  const Vec3 geometric = -vec3(earth_from_sun[0]);
  const Vec3 sun_velocity = vec3(earth[1]) - vec3(earth_from_sun[1]);
  return geometric - sun_velocity * (norm(geometric) * light_time_days_per_au);
}

// Direction seen by an observer who moves with the Earth's centre.
Vec3 with_annual_aberration(Vec3 sun_au, Vec3 earth_velocity_au_per_day) {
  const Vec3 natural = normalized(sun_au);
  const Vec3 v = earth_velocity_au_per_day * light_time_days_per_au;  // in units of c
  double natural_direction[3] = {natural.x, natural.y, natural.z};
  double velocity[3] = {v.x, v.y, v.z};
  double proper_direction[3];
  eraAb(natural_direction, velocity, norm(sun_au), std::sqrt(1 - dot(v, v)), proper_direction);
  return vec3(proper_direction);
}

}  // namespace

double tai_minus_utc_s(UnixTime utc) {
  const CivilTime date = calendar_from_utc(utc);
  const double day_fraction =
      (date.hour * seconds_per_hour + date.minute * seconds_per_minute + date.second) /
      seconds_per_day;
  double seconds = 0;
  // A positive status says only that the year lies outside of the library's table.
  const int status = eraDat(date.year, date.month, date.day, day_fraction, &seconds);
  SUNLOAD_EXPECT(status >= 0, "leap seconds of " + iso_utc(utc));
  return seconds;
}

ApparentSun apparent_sun(JulianDate tt) {
  double earth_from_sun[2][3], earth[2][3];
  eraEpv00(tt.day, tt.fraction, earth_from_sun, earth);
  const Vec3 proper =
      with_annual_aberration(sun_when_light_left(earth_from_sun, earth), vec3(earth[1]));

  double true_from_celestial[3][3];
  eraPnm06a(tt.day, tt.fraction, true_from_celestial);
  const Rotation rotation{
      {vec3(true_from_celestial[0]), vec3(true_from_celestial[1]), vec3(true_from_celestial[2])}};

  // As eraGst06a does it, which would evaluate the nutation series a second time.
  double x = 0, y = 0;
  eraBpn2xy(true_from_celestial, &x, &y);
  const double cio_locator = eraS06(tt.day, tt.fraction, x, y);
  return {rotation(proper) * norm(vec3(earth_from_sun[0])),
          eraEors(true_from_celestial, cio_locator)};
}

Vec3 intermediate_sun_au(JulianDate tt) {
  const ApparentSun sun = apparent_sun(tt);
  return in_axes_turned_about_z(sun.position_au, -sun.equation_of_origins);
}

double earth_rotation_angle(JulianDate ut1) { return eraEra00(ut1.day, ut1.fraction); }

Vec3 in_axes_turned_about_z(Vec3 v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x + s * v.y, c * v.y - s * v.x, v.z};
}

}  // namespace sunload
