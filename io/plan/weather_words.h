// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What is said of a weather file's quantities.
#pragma once

#include <string>
#include <vector>

#include "geo/sun/weather.h"
#include "geo/sun/weather_doubts.h"
#include "io/weather/file.h"

namespace sunload {

/// What light is made from, and how.
std::string source_words(WeatherSource source, Decomposition decomposition);
/// What a record lacks that others have, and how it follows.
std::string completed_words(WeatherSource has, Decomposition decomposition);
/// "DNI 12, DHI 3"
std::string lacking_words(const std::vector<DatedWeather>& weather, WeatherSource source);
/// "DNI and DHI are"
std::string missing_words(const WeatherValues& values, WeatherSource source);

struct WeatherSayings {
  std::vector<std::string> notes, warnings;
};
/// Warns where sun and sky bring much less than the ground receives; empty where they do not.
/// Throws InputError where they bring nothing at all. `path`: of the file.
std::string lacking_light_warning(const Closure& closure, const std::string& path);
/// Warns of values below zero that are taken as 0, and of lower ones that are filled. Throws
/// InputError where `missing` does not let them be.
WeatherSayings below_zero_words(const WeatherFile& file, Missing missing);
/// With amounts; `path`: of the file.
WeatherSayings doubt_words(const WeatherDoubts& doubts, const std::string& path);
/// Of direct light in the dark; a warning where it is much of the light of these records.
WeatherSayings dark_beam_words(const WeatherLight& light, const std::vector<DatedWeather>& weather);

}  // namespace sunload
