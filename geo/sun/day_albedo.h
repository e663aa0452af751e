// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Albedo of the ground day by day, as weather files tell it.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "geo/sun/sun.h"
#include "geo/sun/weather.h"
#include "geo/time/time.h"

namespace sunload {

/// Snow comes and melts in days; how an albedo changes between hours follows the height of the
/// sun, which a diffuse surface cannot follow.
struct DayAlbedos {
  /// Of the civil day of each interval's middle, in (0, 1); empty where the weather tells none.
  std::vector<double> of_interval;
  std::size_t days = 0;  ///< with sun
  /// Of these without an albedo: they have that of the nearest day that has one, of two the
  /// earlier.
  std::size_t filled = 0;
};

/// Sine of the sun's elevation at a time.
using SineOfSun = std::function<double(UnixTime)>;

/// The mean of a day weighs each record by the light on level ground: its GHI, or else DHI and DNI
/// times the sine of the sun's elevation in the middle of the record. Every civil day of `weather`
/// counts, whether `path` touches it or not.
DayAlbedos day_albedos(const std::vector<DatedWeather>& weather, const SunPath& path,
                       const TimeZone& zone, const SineOfSun& sine_at);

}  // namespace sunload
