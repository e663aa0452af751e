// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What is said of the clock of a weather file's stamps.
#pragma once

#include "geo/sun/weather_clock.h"
#include "io/plan/weather_words.h"
#include "io/weather/file.h"

namespace sunload {

/// A note of a shift of a quarter of an hour, a warning of more, with what to write instead.
/// `offset_s`: local standard time minus UTC, as it was taken.
WeatherSayings clock_words(const WeatherClock& clock, const WeatherFile& file, double offset_s);

}  // namespace sunload
