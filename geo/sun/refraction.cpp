// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Air and its refraction of sunlight.
#include <algorithm>
#include <cmath>

#include "geo/base/check.h"
#include "geo/sky/irradiance.h"
#include "geo/sun/sun.h"

namespace sunload {

namespace {

constexpr double pascal_per_hectopascal = 100;

// Reda & Andreas (2008), eq. 42, and the cut-off of its text: the radius of the disk plus the
// refraction at the horizon.
double spa_deg(double elevation_deg, const Air& air) {
  constexpr double cut_off_deg = -(0.26667 + 0.5667);
  constexpr double pressure_hpa = 1010, temperature_k = 283, zero_celsius_k = 273;
  constexpr double scale_arcmin = 1.02, a = 10.3, b = 5.11, arcmin_per_degree = 60;
  if (elevation_deg < cut_off_deg) return 0;
  return air.pressure_pa / pascal_per_hectopascal / pressure_hpa * temperature_k /
         (zero_celsius_k + air.temperature_c) * scale_arcmin /
         (arcmin_per_degree * std::tan(radians(elevation_deg + a / (elevation_deg + b))));
}

// Bennett (1982), with the factor for the air and the rounded arc minute as they are in use.
double bennett_deg(double elevation_deg, const Air& air) {
  constexpr double air_factor = 0.28, zero_celsius_k = 273, degree_per_arcmin = 0.016667;
  constexpr double a = 7.31, b = 4.4;
  constexpr double faded_out_deg = -6;  // end of civil twilight: no sunlight to bend
  // Where x + a/(x + b) is least; below, the formula would turn round and then meet its pole.
  const double largest_at_deg = std::sqrt(a) - b;
  if (elevation_deg < faded_out_deg) return 0;
  const double x = std::max(elevation_deg, largest_at_deg);
  const double fade = elevation_deg < largest_at_deg
                          ? (elevation_deg - faded_out_deg) / (largest_at_deg - faded_out_deg)
                          : 1;
  return fade * air_factor * air.pressure_pa / pascal_per_hectopascal /
         (air.temperature_c + zero_celsius_k) * degree_per_arcmin /
         std::tan(radians(x + a / (x + b)));
}

}  // namespace

Air standard_air(double elevation_m) {
  // ISO 2533 (1975): temperature at sea level and its lapse with height in the troposphere.
  constexpr double sea_level_c = 15, lapse_c_per_m = 0.0065, top_m = 11000;
  SUNLOAD_EXPECT(std::isfinite(elevation_m), "elevation of the air");
  return {.pressure_pa = standard_pressure(elevation_m),
          .temperature_c = sea_level_c - lapse_c_per_m * std::min(elevation_m, top_m)};
}

double refraction_deg(Refraction model, double true_elevation_deg, const Air& air) {
  switch (model) {
    case Refraction::none:
      return 0;
    case Refraction::spa:
      return spa_deg(true_elevation_deg, air);
    case Refraction::bennett:
      return bennett_deg(true_elevation_deg, air);
  }
  contract_failed("known model", __FILE__, __LINE__, "refraction");
}

double sunlit_above_deg(Refraction model, const Air& air) {
  if (model == Refraction::none) return 0;
  // Apparent elevation grows with true elevation, so halving the bracket until its ends are
  // neighbours finds the threshold even at a jump.
  double dark = -6, lit = 1;  // degrees; refraction at the horizon is some 0.6°
  while (true) {
    const double middle = dark + (lit - dark) / 2;
    if (middle <= dark || middle >= lit) return dark;
    (middle + refraction_deg(model, middle, air) > 0 ? lit : dark) = middle;
  }
}

}  // namespace sunload
