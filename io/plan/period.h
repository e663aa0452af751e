// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The intervals that a study's period stands for.
#pragma once

#include <string>
#include <vector>

#include "geo/sun/site.h"
#include "geo/sun/sun.h"
#include "io/study/study.h"

namespace sunload {

/// UTC of a time as a study writes it; what happens to it where clocks change goes to `notes`.
UnixTime utc_of(const ParsedTime& time, const TimeZone& zone, std::vector<std::string>& notes);

/// Steps of a period, and what clocks did to them.
struct PeriodSteps {
  std::vector<PeriodStep> steps;
  std::vector<std::string> notes;  ///< hours that the clocks skip or repeat
};

/// Days and ranges in steps of elapsed time from their civil beginning; a civil
/// day of 23 or 25 hours has that many. A last step is cut at the end.
PeriodSteps period_steps(const PeriodStudy& period, const TimeZone& zone);

/// Positions of the sun as intervals one after another from 2000-01-01T12:00Z.
SunPath positions_path(const PositionsPeriod& period, const Site& site);

}  // namespace sunload
