// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/series_steps.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "geo/base/units.h"
#include "tests/support/refusal_of.h"

namespace sunload::test {
namespace {

using Unit = SeriesStepStudy::Unit;

const TimeZone prague_zone("Europe/Prague");

UnixTime at(int month, int day, int hour = 0) {
  return prague_zone.utc_from_civil({.year = 2026, .month = month, .day = day, .hour = hour}).utc;
}

/// Intervals of that length; the sun is up from 4:00 to 18:00 UTC.
LightSeries intervals(UnixTime begin, UnixTime end, double length_s) {
  LightSeries series;
  for (UnixTime t = begin; t < end; t += length_s) {
    LitInterval interval;
    interval.when.begin = t;
    interval.when.end = std::min(t + length_s, end);
    interval.when.sun_time = t + interval.when.length_s() / 2;
    const CivilTime clock = calendar_from_utc(t);
    interval.when.sunlit_s = clock.hour >= 4 && clock.hour < 18 ? interval.when.length_s() : 0;
    series.intervals.push_back(interval);
  }
  return series;
}

Study with_step(Unit unit, int minutes = 0) {
  Study study;
  study.site.timezone = "Europe/Prague";
  study.output.series_step.unit = unit;
  study.output.series_step.minutes = minutes;
  return study;
}

TEST(SeriesSteps, AreNoneOfIntervals) {
  EXPECT_TRUE(series_steps(with_step(Unit::interval), intervals(at(6, 1), at(6, 2), 600)).empty());
}

TEST(SeriesSteps, HaveTheDaysOfTheClock) {
  const auto light = intervals(at(3, 28), at(3, 31), 600);
  const auto days = series_steps(with_step(Unit::day), light);
  ASSERT_EQ(days.size(), 3U);
  // Clocks go forward on 29 March.
  EXPECT_EQ(days[1].count, 23U * 6);
  EXPECT_EQ(days[1].bounds, (TimeSpan{at(3, 29), at(3, 30)}));
  EXPECT_EQ(days[2].first, 47U * 6);
  EXPECT_EQ(days[2].end(), light.intervals.size());
  // Half of the sunlit time is over at 11:00 UTC.
  for (const auto& day : days)
    EXPECT_EQ(calendar_from_utc(light.intervals[day.sun].when.end).hour, 11);
  const auto hours = series_steps(with_step(Unit::minutes, 60), light);
  EXPECT_EQ(hours.size(), 71U);
  for (const auto& hour : hours) EXPECT_EQ(hour.count, 6U);
}

TEST(SeriesSteps, MayBeCutByThePeriodAndByTheClock) {
  const auto months = series_steps(with_step(Unit::month), intervals(at(1, 30), at(3, 2), 3600));
  ASSERT_EQ(months.size(), 3U);
  EXPECT_EQ(months[0].count, 48U);
  EXPECT_EQ(months[1].count, 28U * 24);
  EXPECT_EQ(months[2].bounds, (TimeSpan{at(3, 1), at(3, 2)}));
  // A day of 23 hours ends with a step of three.
  const auto fours =
      series_steps(with_step(Unit::minutes, 240), intervals(at(3, 29), at(3, 30), 1800));
  ASSERT_EQ(fours.size(), 6U);
  EXPECT_EQ(fours.front().count, 8U);
  EXPECT_EQ(fours.back().count, 6U);
  // In the dark the middle stands for it.
  const auto night =
      series_steps(with_step(Unit::minutes, 120), intervals(at(1, 1), at(1, 2), 600));
  EXPECT_EQ(night.front().sun, 6U);
}

/// A year that is the file's own cannot begin elsewhere.
TEST(SeriesSteps, TellWhatHelpsWhereIntervalsOfAFileLieAcrossMidnight) {
  const auto refused = [](const PeriodStudy& period) {
    Study study = with_step(Unit::day);
    study.period = period;
    return refusal_of([&] { series_steps(study, intervals(at(6, 1) - 300, at(6, 3), 600)); });
  };
  PeriodStudy own;
  own.kind = WeatherPeriod{};
  EXPECT_NE(refused(own).find("light.stamp: start or end"), std::string::npos) << refused(own);
  EXPECT_EQ(refused(own).find("begin the period"), std::string::npos) << refused(own);
  EXPECT_NE(refused({}).find("begin the period"), std::string::npos) << refused({});
}

TEST(SeriesSteps, RefuseWhatTheyAreNotMadeOf) {
  const auto refused = [](Unit unit, int minutes, const LightSeries& light) {
    return refusal_of([&] { series_steps(with_step(unit, minutes), light); });
  };
  const auto ten_minutes = intervals(at(6, 1), at(6, 2), 600);
  EXPECT_NE(refused(Unit::minutes, 15, ten_minutes).find("lies in several steps"),
            std::string::npos);
  EXPECT_NE(refused(Unit::minutes, 5, ten_minutes).find("multiple of the intervals' length"),
            std::string::npos);
  EXPECT_NE(refused(Unit::minutes, 60, intervals(at(6, 1) + 300, at(6, 2), 600)).find("begin the"),
            std::string::npos);
  EXPECT_NE(refused(Unit::day, 0, intervals(at(6, 1) + 1800, at(6, 3), 3600)).find("totals: [day]"),
            std::string::npos);
  auto gap = intervals(at(6, 1), at(6, 3), 3600);
  gap.intervals.erase(gap.intervals.begin() + 5);
  EXPECT_NE(refused(Unit::day, 0, gap).find("nothing is known between"), std::string::npos);
  EXPECT_EQ(series_steps(with_step(Unit::minutes, 60), gap).size(), 47U);
  auto days = intervals(at(6, 1), at(6, 2), 3600);
  const auto later = intervals(at(6, 21), at(6, 22), 3600);
  days.intervals.insert(days.intervals.end(), later.intervals.begin(), later.intervals.end());
  EXPECT_NE(refused(Unit::month, 0, days).find("series_step: day"), std::string::npos);
  EXPECT_EQ(series_steps(with_step(Unit::day), days).size(), 2U);
  auto synthetic = ten_minutes;
  synthetic.times_are_synthetic = true;
  EXPECT_NE(refused(Unit::day, 0, synthetic).find("no clock"), std::string::npos);
}

}  // namespace
}  // namespace sunload::test
