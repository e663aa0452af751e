// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Steps of the clock that stored series are means over (`output.series_step`).
#pragma once

#include <cstddef>
#include <vector>

#include "geo/time/period_parts.h"
#include "io/plan/light_series.h"
#include "io/study/study.h"

namespace sunload {

/// Length of a chunk of series of steps in time.
inline constexpr std::size_t series_step_rows = 16;

/// A run of intervals, each of them in one step alone.
struct SeriesStep {
  TimeSpan bounds{};                 ///< from the begin of its first interval to the last's end
  std::size_t first = 0, count = 0;  ///< intervals
  /// The interval whose sun stands for all of them: in which half of the step's sunlit time is
  /// over; in the dark the middle one.
  std::size_t sun = 0;

  std::size_t end() const { return first + count; }
};

/// In the order of time; none where series are of intervals. Throws InputError where steps are not
/// made of whole intervals without gaps.
std::vector<SeriesStep> series_steps(const Study& study, const LightSeries& light);

}  // namespace sunload
