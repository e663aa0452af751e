// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/time/time.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "geo/base/check.h"
#include "tests/support/reference.h"

namespace sunload {
namespace {

using test::number;
using test::read_csv;

UnixTime instant(const std::string& text) { return utc_from_calendar(parse_time(text).civil); }

ResolvedTime resolved(const std::string& zone, const std::string& wall) {
  return TimeZone(zone).utc_from_civil(parse_time(wall).civil);
}

std::string local(const std::string& zone, const std::string& utc) {
  return iso_local(instant(utc), TimeZone(zone));
}

TEST(Time, ReferenceZoneTraps) {
  for (const auto& row : read_csv("01_solar_position/timezone_traps.csv")) {
    SCOPED_TRACE(row.at("id"));
    const auto result = resolved(row.at("zone"), row.at("wall"));
    const auto& kind = row.at("kind");
    EXPECT_EQ(result.change, kind == "nonexistent" ? ClockChange::skipped
                             : kind == "ambiguous" ? ClockChange::repeated
                                                   : ClockChange::none);
    if (kind == "nonexistent") continue;
    // The first of the two instants of a repeated reading.
    EXPECT_EQ(iso_utc(result.utc), row.at("utc").substr(0, row.at("utc").find(' ')));
  }
}

TEST(Time, SkippedReadingsMoveForwardByTheGap) {
  EXPECT_EQ(iso_utc(resolved("Europe/London", "2024-03-31T01:30").utc), "2024-03-31T01:30:00Z");
  EXPECT_EQ(local("Europe/London", "2024-03-31T01:30:00Z"), "2024-03-31 02:30 +01:00");
  EXPECT_EQ(iso_utc(resolved("Pacific/Apia", "2011-12-30T12:00").utc), "2011-12-30T22:00:00Z");
  EXPECT_EQ(local("Pacific/Apia", "2011-12-30T22:00:00Z"), "2011-12-31 12:00 +14:00");
}

TEST(Time, ReferenceJulianDates) {
  constexpr double half_a_printed_digit = 0.5e-6;
  for (const auto& row : read_csv("01_solar_position/julian_dates.csv")) {
    SCOPED_TRACE(row.at("calendar"));
    const auto date = time_scales(instant(row.at("calendar")), Ut1::zero).utc;
    EXPECT_NEAR(date.day + date.fraction, number(row, "julian_date"), half_a_printed_digit);
  }
}

TEST(Time, SummerTimeGoesOnAfterTheZoneFiles) {
  // Rules of today: last Sundays of March and October; second Sunday of March, first of November.
  EXPECT_EQ(local("Europe/Prague", "2040-03-25T00:59:59Z"), "2040-03-25 01:59:59 +01:00");
  EXPECT_EQ(local("Europe/Prague", "2040-03-25T01:00:00Z"), "2040-03-25 03:00 +02:00");
  EXPECT_EQ(local("Europe/Prague", "2040-10-28T00:59:59Z"), "2040-10-28 02:59:59 +02:00");
  EXPECT_EQ(local("Europe/Prague", "2040-10-28T01:00:00Z"), "2040-10-28 02:00 +01:00");
  EXPECT_EQ(local("America/New_York", "2099-07-04T12:00:00Z"), "2099-07-04 08:00 -04:00");
  EXPECT_EQ(local("Australia/Sydney", "2041-01-01T00:00:00Z"), "2041-01-01 11:00 +11:00");
  EXPECT_EQ(local("Australia/Sydney", "2041-07-01T00:00:00Z"), "2041-07-01 10:00 +10:00");
  EXPECT_EQ(local("Australia/Sydney", "2038-01-01T00:00:00Z"), "2038-01-01 11:00 +11:00");
  EXPECT_EQ(resolved("Europe/Prague", "2044-03-27T02:30").change, ClockChange::skipped);
  EXPECT_EQ(resolved("Europe/Prague", "2044-10-30T02:30").change, ClockChange::repeated);
  EXPECT_EQ(iso_utc(resolved("Europe/Prague", "2044-02-29T12:00").utc), "2044-02-29T11:00:00Z");
}

TEST(Time, ZonesWithoutSummerTimeTodayDoNotGetItBack) {
  // 2040 has the calendar of 2012, when Moscow stood at +04:00 and Sao Paulo had summer time.
  EXPECT_EQ(local("Europe/Moscow", "2040-06-01T00:00:00Z"), "2040-06-01 03:00 +03:00");
  EXPECT_EQ(local("America/Sao_Paulo", "2040-12-21T15:00:00Z"), "2040-12-21 12:00 -03:00");
}

TEST(Time, EveryReadingComesBack) {
  const std::vector<std::string> zones{
      "UTC", "+05:45", "Europe/Prague", "Australia/Lord_Howe", "America/St_Johns", "-03:30"};
  for (const auto& name : zones) {
    const TimeZone zone(name);
    for (int year : {1999, 2026, 2037, 2038, 2050}) {
      for (int hours = 0; hours < 366 * 24; hours += 5) {
        const UnixTime utc =
            utc_from_calendar({.year = year, .month = 1, .day = 1}) + hours * 3600.0 + 0.25;
        const auto back = zone.utc_from_civil(zone.civil_from_utc(utc));
        ASSERT_NE(back.change, ClockChange::skipped) << name << ' ' << iso_utc(utc);
        if (back.change == ClockChange::none) {
          ASSERT_EQ(back.utc, utc) << name << ' ' << iso_utc(utc);
        }
      }
    }
  }
}

TEST(Time, FixedOffsets) {
  EXPECT_EQ(iso_utc(resolved("+05:45", "2025-01-15T09:00").utc), "2025-01-15T03:15:00Z");
  EXPECT_EQ(TimeZone("-0330").offset_s(0), -3.5 * 3600);
  EXPECT_EQ(TimeZone("+01").standard_offset_s(2026), 3600);
  for (const auto* wrong : {"Europe/Pragu", "europe/prague", "", "+25:00", "+01:75", "CEST+1"}) {
    EXPECT_THROW(TimeZone{wrong}, InputError) << wrong;
  }
}

TEST(Time, StandardTimeIsWinterTime) {
  EXPECT_EQ(TimeZone("Europe/Prague").standard_offset_s(2026), 3600);
  EXPECT_EQ(TimeZone("Europe/Dublin").standard_offset_s(2026), 0);
  EXPECT_EQ(TimeZone("Australia/Lord_Howe").standard_offset_s(2026), 10.5 * 3600);
  EXPECT_EQ(TimeZone("America/Denver").standard_offset_s(2045), -7 * 3600);
}

TEST(Time, ParsesWhatAStudyWrites) {
  const auto full = parse_time("2026-06-21 12:00:30.5+02:00");
  EXPECT_TRUE(full.has_time && full.has_offset);
  EXPECT_EQ(full.offset_s, 7200);
  EXPECT_EQ(full.civil.second, 30.5);
  EXPECT_FALSE(parse_time("2026-06-21").has_time);
  EXPECT_FALSE(parse_time("2026-06-21T12:00").has_offset);
  EXPECT_TRUE(parse_time("2026-06-21T12:00Z").has_offset);
  EXPECT_EQ(parse_time("2026-12-31T24:00").civil.year, 2027);
  EXPECT_EQ(parse_time_of_day("24:00"), 86400);
  EXPECT_EQ(parse_time_of_day("05:30:15"), 5.5 * 3600 + 15);
}

TEST(Time, RefusesWhatIsNoTime) {
  for (const auto* wrong :
       {"2026-02-29", "2026-13-01", "2026-00-10", "26-06-21", "2026-06-21T25:00",
        "2026-06-21T12:60", "2026-06-21T24:01", "2026-06-21T12:00+2", "2026-06-21T12:00+19:00",
        "2026-06-21Z", "2026-06-21T23:59:60Z", "noon", "", "2026-06-21T12:00 CEST"}) {
    EXPECT_THROW(parse_time(wrong), InputError) << wrong;
  }
  for (const auto* wrong : {"24:01", "12", "12:60", "-1:00", "12:00:60", ""}) {
    EXPECT_THROW(parse_time_of_day(wrong), InputError) << wrong;
  }
}

TEST(Time, CalendarAndText) {
  EXPECT_EQ(iso_utc(0), "1970-01-01T00:00:00Z");
  EXPECT_EQ(iso_utc(-0.25), "1969-12-31T23:59:59.750Z");
  EXPECT_EQ(iso_utc(59.9999), "1970-01-01T00:01:00Z");
  EXPECT_EQ(iso_utc(-1e-20), "1970-01-01T00:00:00Z");
  EXPECT_EQ(day_of_year({.year = 2024, .month = 12, .day = 31}), 366);
  EXPECT_EQ(day_of_year({.year = 2100, .month = 3, .day = 1}), 60);
  EXPECT_THROW(utc_from_calendar({.year = 2026, .month = 2, .day = 30}), std::logic_error);
}

TEST(Time, ScalesAreThoseOfTheBulletins) {
  const auto minus = [](JulianDate a, JulianDate b) {
    return ((a.day - b.day) + (a.fraction - b.fraction)) * 86400;
  };
  // A day's fraction in double resolves 1e-11 s.
  constexpr double rounding_s = 1e-10;
  const UnixTime t = instant("2026-03-01T00:00");
  EXPECT_NEAR(minus(time_scales(t, Ut1::zero).tt, time_scales(t, Ut1::zero).utc), 69.184,
              rounding_s);
  EXPECT_EQ(minus(time_scales(t, Ut1::zero).ut1, time_scales(t, Ut1::zero).utc), 0);
  // IERS C04: UT1−UTC before and after the leap second of 2016; the table promises 0.05 s.
  constexpr double table_accuracy_s = 0.05;
  const auto ut1_minus_utc = [&](const std::string& text) {
    const auto scales = time_scales(instant(text), Ut1::table);
    return minus(scales.ut1, scales.utc);
  };
  EXPECT_NEAR(ut1_minus_utc("2016-12-31T12:00"), -0.408, table_accuracy_s);
  EXPECT_NEAR(ut1_minus_utc("2017-01-01T12:00"), 0.591, table_accuracy_s);
  EXPECT_NEAR(ut1_minus_utc("1972-07-01T00:00"), 0.362, table_accuracy_s);
  EXPECT_NEAR(ut1_minus_utc("2000-01-01T00:00"), 0.355, table_accuracy_s);
  EXPECT_EQ(ut1_minus_utc("2030-01-01T00:00"), 0);
  EXPECT_TRUE(ut1_table_covers(instant("2025-12-31T23:59")));
  EXPECT_FALSE(ut1_table_covers(instant("2026-01-01T00:00")));
  EXPECT_EQ(ut1_table_end(), instant("2026-01-01T00:00"));
  EXPECT_FALSE(ut1_table_covers(instant("1971-12-31T23:59")));
  // UT1−UTC stays below 0.9 s by definition: a wrong line of the table would break that.
  constexpr double agreed_limit_s = 0.9;
  for (UnixTime day = instant("1972-01-01"); ut1_table_covers(day); day += 86400) {
    ASSERT_LT(std::abs(minus(time_scales(day, Ut1::table).ut1, time_scales(day, Ut1::table).utc)),
              agreed_limit_s)
        << iso_utc(day);
  }
}

}  // namespace
}  // namespace sunload
