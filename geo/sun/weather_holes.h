// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Stretches of time that the rows of a weather file leave out.
#pragma once

#include <cmath>
#include <vector>

#include "geo/sun/sun.h"
#include "geo/sun/weather.h"

namespace sunload {

/// A stretch of at least half a record that no record covers.
struct WeatherHole {
  UnixTime begin = 0, end = 0;
  int line = 0;        ///< of the record behind it
  int whole_days = 0;  ///< as long as so many
  /// Without values, of the length of the record before it: those with sun in their middle, or for
  /// an hour. None where they are of two days: that is another campaign, or hours that nobody
  /// measures.
  std::vector<DatedWeather> records;
};

/// Holes in which a record, or an hour of a longer one, would have sun from its beginning to its
/// end: rows of the dark, and of sunrise and sunset, may be left out, as WEA files do where they
/// are 0. `weather` is in order; the sun is that of the station, whose midnights its longitude
/// tells: stamps may be in UTC.
std::vector<WeatherHole> sunlit_holes(const std::vector<DatedWeather>& weather,
                                      const SunEphemeris& sun, double longitude_deg);

/// How many rows as long as the first of two are missing between them; less than a half is rounding
/// of stamps, or another clock.
inline double rows_left_out(const DatedWeather& before, const DatedWeather& behind) {
  return std::round((behind.begin - before.end) / (before.end - before.begin));
}

/// Both in order.
std::vector<DatedWeather> with_records_of(const std::vector<WeatherHole>& holes,
                                          const std::vector<DatedWeather>& weather);

}  // namespace sunload
