// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Weather in other steps than its own.
#pragma once

#include <cstddef>
#include <vector>

#include "geo/sun/weather.h"

namespace sunload {

/// Means over other intervals, each overlapped by as much as there is. DNI and DHI are level within
/// the sunlit part of a record, what GHI has beyond DHI follows the sines of the suns of intervals
/// that lie inside of it, its sum kept.
struct Resampled {
  std::vector<Irradiance> mean;  ///< of an open horizon
  /// The same with as much of the beam as comes while no hill hides the sun: of every record what
  /// both sunlit parts (SunInterval::sunlit_s) have in common.
  std::vector<Irradiance> past_hills;
  std::vector<std::size_t> uncovered;  ///< intervals that weather does not cover, or not wholly
};
Resampled resample(const std::vector<SunnyWeather>& weather, const SunPath& path);

}  // namespace sunload
