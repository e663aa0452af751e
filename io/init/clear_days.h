// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Days of a weather file on which a first picture shows something: shadows need sun.
#pragma once

#include <vector>

#include "geo/sun/weather.h"
#include "geo/time/time.h"

namespace sunload {

/// The clearest days, by direct light (or all light, where that is what the file has), that lack
/// no value (where there is such a day): within a fortnight of 21 March, 21 June and 21 December
/// where the records are of most of a year, else of each third of their days. In that order. 29
/// February is none, as few years have it. `source`: what light is made from.
std::vector<CivilTime> clear_days(const std::vector<WeatherRecord>& records, WeatherSource source);

}  // namespace sunload
