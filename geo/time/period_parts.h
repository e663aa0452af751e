// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Parts of a period in civil time: its months, seasons, days and hours of day.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "geo/time/time.h"

namespace sunload {

/// How a period is divided. Months and days are those of the calendar, each for itself; seasons are
/// whole months (winter: December, January, February; half a year later south of the equator), and
/// seasons and hours of day are put together from all years and days.
enum class PartKind : std::uint8_t { month, season, day, hour_of_day };
inline constexpr std::size_t part_kind_count = 4;
inline constexpr std::array<const char*, part_kind_count> part_kind_names{"month", "season", "day",
                                                                          "hour_of_day"};
inline constexpr std::array<const char*, 4> season_names{"spring", "summer", "autumn", "winter"};

/// Begin and end [UTC].
using TimeSpan = std::array<UnixTime, 2>;

/// What an interval gives to a part: the share of its time, above 0 and at most 1.
struct PartShare {
  std::size_t interval = 0;
  double share = 1;
};

/// One month, season, day or hour of day, and the intervals that it is made of.
struct PeriodPart {
  std::string label;                 ///< "2026-06", "summer", "2026-06-21", "8"
  TimeSpan bounds{};                 ///< of the month or day in the calendar, else zeros
  double duration_s = 0;             ///< of the intervals in it
  std::vector<PartShare> intervals;  ///< in their order
};

/// All parts of a period of one kind.
struct PeriodDivision {
  PartKind kind = PartKind::month;
  std::vector<PeriodPart> parts;  ///< that have time; in the order of time, of the year, of the day
};

/// The hours of the clock that a stretch of time is made of, one after the other: within each of
/// them month, day and hour of `zone` stay.
std::vector<TimeSpan> clock_hours(TimeSpan time, const TimeZone& zone);

/// 0 … 3, a place in `season_names`.
std::size_t season_of(int month, double latitude_deg);

/// `intervals` of positive length, in civil time of `zone`. Shares of an interval add up to 1, and
/// one that lies in a single part gives it 1. South of the equator: `latitude_deg` below 0.
PeriodDivision divided(PartKind kind, const std::vector<TimeSpan>& intervals, const TimeZone& zone,
                       double latitude_deg);

/// Steps of so many seconds of elapsed time, counted from every midnight of `zone`; the last of a
/// day ends with it. Their labels are empty.
std::vector<PeriodPart> clock_steps(double step_s, const std::vector<TimeSpan>& intervals,
                                    const TimeZone& zone);

}  // namespace sunload
