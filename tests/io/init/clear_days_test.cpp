// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The days of a first picture have sun and lack nothing.
#include "io/init/clear_days.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

namespace sunload {
namespace {

using Dates = std::vector<std::string>;
/// Direct light of a day at noon; absent: missing.
using NoonDni = std::function<std::optional<double>(const CivilTime&)>;

std::vector<WeatherRecord> weather(int year, int days, const NoonDni& dni) {
  std::vector<WeatherRecord> records;
  for (int d = 0; d < days; ++d) {
    const CivilTime date = calendar_from_utc(utc_from_calendar({.year = year}) + 86400.0 * d);
    for (const double hour : {6.0, 12.0, 18.0})
      records.push_back({.year = year,
                         .month = date.month,
                         .day = date.day,
                         .begin_s = 3600 * hour,
                         .end_s = 3600 * (hour + 6),
                         .values = {.dni = dni(date), .dhi = 50, .ghi = {}}});
  }
  return records;
}

Dates dates_of(const std::vector<WeatherRecord>& records) {
  Dates dates;
  for (const CivilTime& day : clear_days(records, WeatherSource::dni_and_dhi))
    dates.push_back(std::to_string(day.year) + "-" + std::to_string(day.month) + "-" +
                    std::to_string(day.day));
  return dates;
}

TEST(ClearDays, AreNearEquinoxAndSolstices) {
  const auto sunny = [](const CivilTime& d) {
    const bool is_clear = (d.month == 3 && d.day == 25) || (d.month == 6 && d.day == 9) ||
                          (d.month == 1 && d.day == 2) || d.month == 8;
    return is_clear ? 900.0 : 100.0;
  };
  EXPECT_EQ(dates_of(weather(2026, 365, sunny)), (Dates{"2026-3-25", "2026-6-9", "2026-1-2"}));
}

TEST(ClearDays, LackNothing) {
  const auto broken = [](const CivilTime& d) -> std::optional<double> {
    if (d.month == 6 && d.day == 20) return {};
    return d.day == 20 ? 900.0 : d.day == 18 ? 800.0 : 100.0;
  };
  EXPECT_EQ(dates_of(weather(2024, 366, broken)), (Dates{"2024-3-20", "2024-6-18", "2024-12-20"}));
}

TEST(ClearDays, OfAFewWeeksAreOneOfEachThird) {
  const auto sunny = [](const CivilTime& d) { return d.day % 10 == 7 ? 900.0 : 100.0; };
  EXPECT_EQ(dates_of(weather(2026, 30, sunny)), (Dates{"2026-1-7", "2026-1-17", "2026-1-27"}));
  EXPECT_EQ(dates_of(weather(2026, 1, sunny)), (Dates{"2026-1-1"}));
  EXPECT_EQ(dates_of({}), Dates{});
}

/// Files may leave out the dark, and stamps that end their stretch put a record more on one day.
TEST(ClearDays, AreAsWholeAsThoseAboutThem) {
  const auto sunny = [](const CivilTime& d) { return d.day == 20 ? 900.0 : 100.0; };
  auto records = weather(2026, 365, sunny);
  WeatherRecord more = records[3 * 58];  // 28 February
  more.begin_s = 0;
  more.end_s = 3600;
  records.insert(records.begin() + 3 * 58, more);
  EXPECT_EQ(dates_of(records), (Dates{"2026-3-20", "2026-6-20", "2026-12-20"}));
  std::erase_if(records, [](const WeatherRecord& r) {
    return (r.month < 4 || r.month > 9) && r.begin_s >= 18 * 3600;
  });
  EXPECT_EQ(dates_of(records), (Dates{"2026-3-20", "2026-6-20", "2026-12-20"}));
  // A row that is missing on the clearest day is none of the dark.
  std::erase_if(records, [](const WeatherRecord& r) {
    return r.month == 6 && r.day == 20 && r.begin_s == 6 * 3600;
  });
  EXPECT_NE(dates_of(records)[1], "2026-6-20");
}

TEST(ClearDays, AreThereWhereEveryDayLacksSomething) {
  const auto none = [](const CivilTime&) { return std::optional<double>(); };
  EXPECT_EQ(dates_of(weather(2026, 30, none)).size(), 3u);
}

}  // namespace
}  // namespace sunload
