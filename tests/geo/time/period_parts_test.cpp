// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Months, seasons, days and hours of a period in civil time.
#include "geo/time/period_parts.h"

#include <gtest/gtest.h>

#include "geo/base/units.h"

namespace sunload {
namespace {

const TimeZone prague("Europe/Prague");
constexpr double latitude = 50;

UnixTime at(int month, int day, int hour, const TimeZone& zone = prague) {
  return zone.utc_from_civil({.year = 2026, .month = month, .day = day, .hour = hour}).utc;
}

/// Steps of that length from `begin` to `end`.
std::vector<TimeSpan> steps(UnixTime begin, UnixTime end, double length_s) {
  std::vector<TimeSpan> all;
  for (int k = 0; begin + k * length_s < end; ++k)
    all.push_back({begin + k * length_s, begin + (k + 1) * length_s});
  return all;
}

std::vector<std::string> labels(const PeriodDivision& division) {
  std::vector<std::string> words;
  for (const auto& part : division.parts) words.push_back(part.label);
  return words;
}

using Labels = std::vector<std::string>;

TEST(PeriodParts, AYearHasItsMonthsAndDaysWhateverTheClocksDo) {
  const auto year = steps(at(1, 1, 0), at(12, 31, 0) + seconds_per_day, seconds_per_hour);
  const auto months = divided(PartKind::month, year, prague, latitude);
  ASSERT_EQ(months.parts.size(), 12U);
  EXPECT_EQ(months.parts[5].label, "2026-06");
  EXPECT_EQ(months.parts[5].bounds, (TimeSpan{at(6, 1, 0), at(7, 1, 0)}));
  // An hour is lost in March and found in October.
  EXPECT_EQ(months.parts[2].duration_s, (31 * 24 - 1) * seconds_per_hour);
  EXPECT_EQ(months.parts[9].duration_s, (31 * 24 + 1) * seconds_per_hour);
  const auto days = divided(PartKind::day, year, prague, latitude);
  EXPECT_EQ(days.parts.size(), 365U);
  EXPECT_EQ(days.parts.back().label, "2026-12-31");
  const auto hours = divided(PartKind::hour_of_day, year, prague, latitude);
  ASSERT_EQ(hours.parts.size(), 24U);
  EXPECT_EQ(hours.parts[2].duration_s, 365 * seconds_per_hour);  // one lost, one twice
  for (const auto* division : {&months, &days, &hours})
    for (const auto& part : division->parts)
      for (const auto& share : part.intervals) ASSERT_EQ(share.share, 1);
}

TEST(PeriodParts, StepsOfTheClockBeginAtMidnight) {
  const auto days = steps(at(3, 28, 0), at(3, 31, 0), seconds_per_hour);
  const auto hours = clock_steps(4 * seconds_per_hour, days, prague);
  ASSERT_EQ(hours.size(), 18U);
  // Clocks go forward at 2:00 on the 29th, whose last step ends with the day.
  EXPECT_EQ(hours[6].bounds, (TimeSpan{at(3, 29, 0), at(3, 29, 5)}));
  EXPECT_EQ(hours[11].bounds, (TimeSpan{at(3, 29, 21), at(3, 30, 0)}));
  EXPECT_EQ(hours[11].duration_s, 3 * seconds_per_hour);
  EXPECT_EQ(hours[12].intervals.front().interval, 47U);
  // An interval over a step's end gives each its share.
  const auto shared =
      clock_steps(seconds_per_hour, {{at(6, 1, 5) + 2700, at(6, 1, 6) + 900}}, prague);
  ASSERT_EQ(shared.size(), 2U);
  EXPECT_DOUBLE_EQ(shared[1].intervals[0].share, 0.5);
}

TEST(PeriodParts, SeasonsAreWholeMonthsAndTurnWithTheHemisphere) {
  const auto noons = [&](int month) { return TimeSpan{at(month, 9, 12), at(month, 9, 13)}; };
  const std::vector<TimeSpan> days{noons(1), noons(2), noons(3), noons(7), noons(12)};
  const auto north = divided(PartKind::season, days, prague, latitude);
  EXPECT_EQ(labels(north), (Labels{"spring", "summer", "winter"}));
  EXPECT_EQ(north.parts[2].intervals.size(), 3U);  // December with January and February
  EXPECT_EQ(labels(divided(PartKind::season, days, prague, -latitude)),
            (Labels{"summer", "autumn", "winter"}));
}

// 40 minutes from 6:30 on: 7:00 and 8:00 cut intervals.
TEST(PeriodParts, AnIntervalIsSharedByTheHoursItLiesIn) {
  const auto intervals = steps(at(6, 21, 6) + 1800, at(6, 21, 8) + 1800, 2400);
  const auto hours = divided(PartKind::hour_of_day, intervals, prague, latitude);
  ASSERT_EQ(labels(hours), (Labels{"6", "7", "8"}));
  EXPECT_DOUBLE_EQ(hours.parts[0].intervals[0].share, 0.75);
  EXPECT_DOUBLE_EQ(hours.parts[1].intervals[0].share, 0.25);
  std::vector<double> sum(intervals.size(), 0);
  double duration_s = 0;
  for (const auto& part : hours.parts) {
    duration_s += part.duration_s;
    for (const auto& [interval, share] : part.intervals) sum[interval] += share;
  }
  for (const double share : sum) EXPECT_NEAR(share, 1, 1e-15);
  EXPECT_NEAR(duration_s, 7200, 1e-9);
}

TEST(PeriodParts, ANightBelongsToTwoDaysOfItsZone) {
  const std::vector<TimeSpan> night{{at(6, 30, 21), at(6, 30, 21) + 6 * seconds_per_hour}};
  EXPECT_EQ(labels(divided(PartKind::day, night, prague, latitude)),
            (Labels{"2026-06-30", "2026-07-01"}));
  EXPECT_EQ(labels(divided(PartKind::month, night, TimeZone("-06:00"), latitude)),
            Labels{"2026-06"});
}

// Lord Howe Island turns its clocks by half an hour.
TEST(PeriodParts, ClocksMayTurnByHalfAnHour) {
  const TimeZone zone("Australia/Lord_Howe");
  const UnixTime begin = at(10, 4, 0, zone);
  const auto hours = clock_hours({begin, begin + 4 * seconds_per_hour}, zone);
  for (const auto& [from, to] : hours) {
    EXPECT_EQ(zone.civil_from_utc(from).hour, zone.civil_from_utc(to - 1).hour);
    EXPECT_LT(from, to);
  }
  EXPECT_EQ(hours.back()[1], begin + 4 * seconds_per_hour);
}

}  // namespace
}  // namespace sunload
