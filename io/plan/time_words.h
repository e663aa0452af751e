// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Time, north and a self-test with a stick, in words.
#pragma once

#include <string>
#include <vector>

#include "io/plan/light_series.h"

namespace sunload {

/// Where the scene's +y axis points.
std::string north_words(double north_deg);

/// Changes of the clocks on the days of a series, with the hours that such a day has; empty where
/// there are none.
std::string clock_words(const LightSeries& light, const TimeZone& zone);

/// The shadow of a 1 m pole at local noon: a check that anybody can make outdoors. On the first of
/// the days of `times` (increasing) whose noon sun stands 5 degrees high, else on that with the
/// highest.
std::string pole_words(const Site& site, const std::vector<UnixTime>& times, const TimeZone& zone,
                       const SunStudy& sun = {});

/// Which instant and interval the first and last values belong to, sunrise and sunset of the first
/// day, changes of the clocks, hills, where north is, and length and bearing of the shadow of a 1 m
/// pole at local noon.
std::string time_words(const LightSeries& light, const Site& site, const Study& study,
                       const std::string& site_source);

}  // namespace sunload
