// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Instants and times as text.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <string>

#include "geo/base/check.h"
#include "geo/base/pattern.h"
#include "geo/base/units.h"
#include "geo/time/time.h"

namespace sunload {

namespace {

constexpr int minutes_per_hour = 60;

bool is_date(int year, int month, int day) {
  // No calendar has a year 0, and its first hours would be of a year before.
  return year > 0 && std::chrono::year_month_day{std::chrono::year{year},
                                                 std::chrono::month{static_cast<unsigned>(month)},
                                                 std::chrono::day{static_cast<unsigned>(day)}}
                         .ok();
}

// Seconds since midnight; 24:00 is the end of the day.
double checked_seconds(int hour, int minute, double second, const std::string& text) {
  const double result = hour * seconds_per_hour + minute * seconds_per_minute + second;
  if (minute >= minutes_per_hour || second >= seconds_per_minute || result > seconds_per_day) {
    throw InputError({}, "'" + text + "' is no time of day",
                     "hours 00 to 24, minutes and seconds 00 to 59");
  }
  return result;
}

double checked_offset(const std::string& zone, const std::string& text) {
  if (zone == "Z") return 0;
  try {
    return TimeZone(zone).offset_s(0);
  } catch (const InputError&) {
    throw InputError({}, "'" + text + "' has an impossible offset from UTC", "'" + zone + "'",
                     "write Z or an offset such as +02:00");
  }
}

double number(const Pattern::Part& part) { return part.matched ? std::stod(part.text) : 0; }
int integer(const Pattern::Part& part) { return part.matched ? std::stoi(part.text) : 0; }

}  // namespace

std::string iso_utc(UnixTime utc) {
  constexpr double parts_per_second = 1000;
  const double rounded = std::round(utc * parts_per_second) / parts_per_second;
  const double whole = std::floor(rounded);
  const CivilTime t = calendar_from_utc(whole);
  const auto parts = static_cast<int>(std::round((rounded - whole) * parts_per_second));
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02.0f}{}Z", t.year, t.month, t.day, t.hour,
                     t.minute, t.second, parts == 0 ? "" : fmt::format(".{:03}", parts));
}

std::string offset_text(double offset_s) {
  const auto minutes = static_cast<int>(std::lround(std::abs(offset_s) / seconds_per_minute));
  return fmt::format("{}{:02}:{:02}", offset_s < 0 && minutes > 0 ? '-' : '+',
                     minutes / minutes_per_hour, minutes % minutes_per_hour);
}

std::string iso_local(UnixTime utc, const TimeZone& zone) {
  const double rounded = std::round(utc);
  const CivilTime t = zone.civil_from_utc(rounded);
  return fmt::format("{:04}-{:02}-{:02} {:02}:{:02}{} {}", t.year, t.month, t.day, t.hour, t.minute,
                     t.second > 0 ? fmt::format(":{:02.0f}", t.second) : "",
                     offset_text(zone.offset_s(rounded)));
}

ParsedTime parse_time(const std::string& text) {
  static const Pattern pattern(R"((\d{4})-(\d{2})-(\d{2}))"                        // date
                               R"((?:[T ](\d{2}):(\d{2})(?::(\d{2}(?:\.\d+)?))?)"  // time
                               R"( ?(Z|[+-]\d{2}(?::?\d{2})?)?)?)");               // zone
  enum { year_part = 1, month_part, day_part, hour_part, minute_part, second_part, zone_part };
  const auto found = pattern.whole(text);
  if (!found) {
    throw InputError({}, "'" + text + "' is no time",
                     "YYYY-MM-DD, YYYY-MM-DDTHH:MM[:SS], then Z, +HH:MM or nothing, is read",
                     "write for example 2026-06-21T12:00");
  }
  const auto& part = *found;
  const int year = integer(part[year_part]), month = integer(part[month_part]),
            day = integer(part[day_part]);
  if (!is_date(year, month, day)) {
    throw InputError({}, "'" + text + "' is no date of the calendar", "",
                     "write YYYY-MM-DD, for example 2026-06-21");
  }
  const double of_day = checked_seconds(integer(part[hour_part]), integer(part[minute_part]),
                                        number(part[second_part]), text);
  ParsedTime result;
  // Going through the time line turns 24:00 into the next day's 00:00.
  result.civil =
      calendar_from_utc(utc_from_calendar({.year = year, .month = month, .day = day}) + of_day);
  result.has_time = part[hour_part].matched;
  result.has_offset = part[zone_part].matched;
  if (result.has_offset) result.offset_s = checked_offset(part[zone_part].text, text);
  return result;
}

double parse_time_of_day(const std::string& text) {
  static const Pattern pattern(R"((\d{1,2}):(\d{2})(?::(\d{2}(?:\.\d+)?))?)");
  const auto found = pattern.whole(text);
  if (!found) {
    throw InputError({}, "'" + text + "' is no time of day", "HH:MM or HH:MM:SS is read",
                     "write for example \"05:00\"");
  }
  return checked_seconds(integer((*found)[1]), integer((*found)[2]), number((*found)[3]), text);
}

}  // namespace sunload
