// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Measured and typical weather: sun and sky power in stretches of time.
///
/// Irradiances are means over the whole stretch [W m-2]. Direct light comes only while
/// the sun is up, so a stretch that is divided gives its beam to the sunlit part of each
/// piece, and its diffuse light to the whole of it (docs/developer/design.md, Study).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "geo/sky/irradiance.h"
#include "geo/sun/site.h"
#include "geo/sun/sun.h"

namespace sunload {

/// Overlaps and gaps of less are rounding of stamps.
inline constexpr double same_time_s = 1e-3;

/// Of the elevation of an interval's sun; 0 below the horizon.
double sine_of_sun(const SunInterval& when);

/// Which instant of a row's stretch its stamp names.
enum class Stamp { start, middle, end };

/// What a file says about one stretch; absent: no such column, or a missing value.
struct WeatherValues {
  std::optional<double> dni, dhi, ghi;
  std::optional<double> albedo{};  ///< of the ground, in (0, 1)
};

/// One of them.
using WeatherQuantity = std::optional<double> WeatherValues::*;

/// One row of a weather file, in local standard time.
struct WeatherRecord {
  int year = 0;                   ///< 0: the format has none, or the readers found a typical year
  int month = 1, day = 1;         ///< of the stamp, or the one before where it begins there
  double begin_s = 0, end_s = 0;  ///< since that day's midnight; may lie outside of the day
  WeatherValues values;
  int line = 0;
};

/// A record in UTC.
struct DatedWeather {
  UnixTime begin = 0, end = 0;
  WeatherValues values;
  int line = 0;
};

/// actual: as it was, in one stretch or in several with any time between them; typical: months of
/// different years, or rows without a year.
enum class WeatherYears { actual, typical };
/// Typical are dates that go back, and those of twelve whole months, each of one year and of
/// another name, whose years do not follow each other: a typical year's years may rise by chance.
WeatherYears years_of(const std::vector<WeatherRecord>& records);
/// Whether each record is of the year of the one before it, or of the next one where its month is
/// an earlier one.
bool years_follow(const std::vector<WeatherRecord>& records);

/// The records in UTC: in their own years, or with the first one in `first_year`. 29 February is
/// left out of years that have none. `offset_s`: local standard time minus UTC.
std::vector<DatedWeather> dated(const std::vector<WeatherRecord>& records,
                                std::optional<int> first_year, double offset_s);

/// The first record that begins before the one before it ends; its size if there is none.
/// A millisecond does not count.
std::size_t first_out_of_order(const std::vector<DatedWeather>& weather);

/// What to do about missing values.
enum class Missing { refuse, interpolate, zero };

/// Which values light is made from.
enum class WeatherSource {
  dni_and_dhi,  ///< as measured
  ghi_and_dhi,  ///< DNI = (GHI - DHI) / sin(elevation), at most extraterrestrial: the rest is DHI
  ghi_and_dni,  ///< DHI = GHI - DNI sin(elevation), at least 0
  ghi_alone,    ///< decomposed
  none
};
/// By what any of the records has.
WeatherSource source_of(const std::vector<DatedWeather>& weather);
/// By what a record has itself.
WeatherSource source_of(const WeatherValues& values);
/// Quantities that light of the source is made from.
std::vector<WeatherQuantity> needed(WeatherSource source);
/// Whether a value that the source needs is missing.
bool is_incomplete(const WeatherValues& values, WeatherSource source);

/// Models that divide global irradiance where nothing else is measured.
enum class Decomposition { erbs, disc };

/// The sun's own beam outside of the atmosphere, to which no sky adds, as a mean over an interval
/// in which the sun may be up for a part [W m-2].
double strongest_beam(const SunInterval& when);

/// A record with all three quantities: what it lacks follows from what it has (any source but
/// `none`) and its sun, as it does in a file without that column.
WeatherValues completed(const WeatherValues& values, const SunInterval& when,
                        Decomposition decomposition, double elevation_m);

/// Weather after `fill_missing`, and how much was missing.
struct FilledWeather {
  std::vector<DatedWeather> weather;
  std::size_t records = 0;  ///< that had something missing
  double longest_gap_s = 0;
};
/// Fills the values that `source` needs. interpolate: gaps of at most 3 hours linearly in
/// time, longer ones with the same hour of the nearest days before and after that have it,
/// weighted by their distance; zero: 0. With `refuse` nothing is filled, only counted.
FilledWeather fill_missing(std::vector<DatedWeather> weather, WeatherSource source,
                           Missing missing);

/// Weather with its sun: DNI is 0 where the sun is not up. Stations have an open horizon: hills
/// around the site are none of this file's business (`up_s` counts, not `sunlit_s`).
struct SunnyWeather {
  SunInterval when;
  Irradiance mean;
};
/// Records as light, and beams that came at night.
struct WeatherLight {
  std::vector<SunnyWeather> intervals;
  std::size_t dark_beams = 0;    ///< intervals with DNI but without sun …
  double dropped_dni_wh_m2 = 0;  ///< … and their direct light, which is dropped
};
/// `path` has one interval for each record, which has what `source` needs. GHI is the
/// measured one where there is one, else DNI·sin(elevation) + DHI.
WeatherLight with_sun(const std::vector<DatedWeather>& weather, const SunPath& path,
                      WeatherSource source, Decomposition decomposition, double elevation_m);

/// GHI against DNI·sin(elevation) + DHI over the intervals with sun where all three are measured.
struct Closure {
  std::size_t intervals = 0;
  double mean_ghi = 0;       ///< W m-2
  double bias = 0, rms = 0;  ///< of the sum minus GHI, W m-2
  double worst = 0;          ///< residual of the largest size
  UnixTime worst_at = 0;
  /// By how much later [s] the sun had to be taken to fit best, out of shifts by half and
  /// whole steps, with the root mean square that is left: tells wrong stamps and zones.
  double best_shift_s = 0, best_rms = 0;
};
Closure closure(const std::vector<DatedWeather>& weather, const SunPath& path,
                const SunEphemeris& sun);

/// Great-circle distance on a sphere of mean radius [m].
double distance_m(const Site& a, const Site& b);

}  // namespace sunload
