// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Measured quantities that contradict each other, or the sun.
#pragma once

#include <cstddef>
#include <vector>

#include "geo/sun/sun.h"
#include "geo/sun/weather.h"

namespace sunload {

/// What the measured quantities of some records leave open.
struct WeatherDoubt {
  std::size_t records = 0;
  double wh_m2 = 0;            ///< sum of the horizontal irradiance in question
  int line = 0;                ///< of the first such record …
  double is = 0, at_most = 0;  ///< … and its two values [W m-2]
};
/// From this elevation of the sun on the darkest clouds let more through than instruments round off
/// [degrees].
inline constexpr double surely_light_deg = 10;
/// Records whose quantities contradict each other, or the sun, while nothing else was measured
/// that could tell (where all three are, `closure` does).
struct WeatherDoubts {
  double ghi_wh_m2 = 0;  ///< of all records that have it
  /// GHI - DHI above the sun's beam outside of the atmosphere, which is 0 in the dark.
  WeatherDoubt beam_by_difference;
  WeatherDoubt dhi_above_ghi;
  WeatherDoubt beam_above_ghi;  ///< DNI·sin(elevation), of records without DHI
  WeatherDoubt dni;             ///< measured, above that of the sun outside of the atmosphere
  WeatherDoubt no_light;        ///< all that is measured is 0, while the sun stands high
  std::size_t high_suns = 0;    ///< records of the sky's light while the sun stands so …
  double most_w_m2 = 0;         ///< … and the largest value of any quantity in them
};
/// `weather`: as it was read; `path` has one interval for each record.
WeatherDoubts doubts_of(const std::vector<DatedWeather>& weather, const SunPath& path);

}  // namespace sunload
