/// Time, north and a self-test with a stick, in words.
#pragma once

#include <string>

#include "io/light_series.h"

namespace sunload {

/// Where the scene's +y axis points.
std::string north_words(double north_deg);

/// The shadow of a 1 m pole at local noon of the day of `first`: a check that
/// anybody can make outdoors.
std::string pole_words(const Site& site, UnixTime first, const TimeZone& zone,
                       const SunStudy& sun = {});

/// Which instant and interval the first and last values belong to, where north
/// is, and length and bearing of the shadow of a 1 m pole at local noon.
std::string time_words(const LightSeries& light, const Site& site, const Study& study,
                       const std::string& site_source);

}  // namespace sunload
