// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Whether weather keeps the clock that its stamps are read by: told by the light of clear days.
///
/// The light of a clear day is that of a plain model of the sun's height, times a factor. Of each
/// day the shift of the model is sought that brings it nearest to the records, as means over
/// theirs; days whose shape fits are clear. A wrong clock moves the flanks of morning and evening
/// alike, hills and fog one of them: both must tell of the shift, on three of four days.
///
/// A day's light is symmetric about the sun's noon; that a day is clear is told by the shape of its
/// light, as by Reno & Hansen (2016), Identification of periods of clear sky irradiance in time
/// series of GHI measurements, Renewable Energy 90, p. 520.
#pragma once

#include <cstddef>
#include <vector>

#include "geo/sun/sun.h"
#include "geo/sun/weather.h"

namespace sunload {

/// Half of the days tell of less, a quarter of each side of it of more.
struct Quartiles {
  double lower = 0, median = 0, upper = 0;
  /// The one nearer to zero; 0 where they lie on both sides of it.
  double surely() const;
};

/// By how much later [s] than the sun's the light of clear days comes.
struct ClockShift {
  std::size_t days = 0;
  Quartiles whole, morning, evening;
  /// Whether it is as long as that beyond doubt: of enough days, of which three of four have much
  /// of it, in the morning as well as in the evening.
  bool exceeds(double length_s) const;
};

/// Of all clear days, and of those in which clocks are surely advanced where they are in summer, or
/// surely are not.
struct WeatherClock {
  ClockShift all, summer, winter;
  /// Beyond doubt the two differ by about the hour that clocks are advanced by.
  bool has_summer_time() const;
};

/// `weather`: in order; records without values of light are none. `sun`: of the place where it was
/// measured, with a margin of a day; `latitude_deg`, `longitude_deg`: of that place.
WeatherClock clock_of(const std::vector<DatedWeather>& weather, const SunEphemeris& sun,
                      double latitude_deg, double longitude_deg);

}  // namespace sunload
