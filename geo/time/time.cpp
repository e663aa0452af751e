// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Calendar and civil time zones.
#include "geo/time/time.h"

#include <date/tz.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <exception>
#include <optional>
#include <string>

#include "geo/base/check.h"
#include "geo/base/pattern.h"
#include "geo/base/units.h"

namespace sunload {

namespace {

using std::chrono::seconds;

constexpr int february = 2, july = 7;

date::year_month_day year_month_day(const CivilTime& t) {
  const auto month = static_cast<unsigned>(t.month), day = static_cast<unsigned>(t.day);
  const auto result = date::year{t.year} / date::month{month} / date::day{day};
  SUNLOAD_EXPECT(t.month > 0 && t.day > 0 && result.ok(), "calendar date");
  return result;
}

double seconds_since_midnight(const CivilTime& t) {
  return t.hour * seconds_per_hour + t.minute * seconds_per_minute + t.second;
}

// `+hh:mm`, `+hhmm` or `+hh`: seconds east of UTC.
std::optional<double> parsed_offset_s(const std::string& text) {
  static const Pattern pattern(R"(([+-])(\d{2})(?::?(\d{2}))?)");
  constexpr int largest_offset_h = 14;  // Kiritimati
  const auto found = pattern.whole(text);
  if (!found) return std::nullopt;
  const auto& part = *found;
  const int hours = std::stoi(part[2].text);
  const int minutes = part[3].matched ? std::stoi(part[3].text) : 0;
  if (minutes >= 60 || hours * 60 + minutes > largest_offset_h * 60) return std::nullopt;
  const double offset = hours * seconds_per_hour + minutes * seconds_per_minute;
  return part[1].text == "-" ? -offset : offset;
}

const date::time_zone& as_zone(const void* zone) {
  return *static_cast<const date::time_zone*>(zone);
}

// The compiled zone files of the system end in 2037; what they say of later times is the state
// after their last change, be it summer or winter.
constexpr date::year last_year_of_zone_files{2037};

bool beyond_zone_file(date::year year, const date::sys_info& info) {
  return year > last_year_of_zone_files &&
         info.end >= date::sys_days{date::year::max() / 12 / date::last};
}

// Whole days from a date to one like it that the zone files know: in the latest year whose
// 1 March (1 January for dates before March) falls on the same weekday, so that rules such as
// "last Sunday of October" give the same answer under the zone's newest rules. Eleven years hold
// all seven weekdays; leap years need no twins, because no zone changes its clocks on 29 February.
date::days to_equivalent_year(date::year_month_day date) {
  const bool early = static_cast<unsigned>(date.month()) <= february;
  const auto anchor = [&](date::year year) {
    return date::sys_days{year / (early ? date::January : date::March) / 1};
  };
  const auto from = anchor(date.year());
  auto year = last_year_of_zone_files;
  while (date::weekday{anchor(year)} != date::weekday{from}) --year;
  return anchor(year) - from;
}

date::sys_info zone_state(const date::time_zone& zone, date::sys_seconds t) {
  const date::year_month_day date{date::floor<date::days>(t)};
  const auto info = zone.get_info(t);
  return beyond_zone_file(date.year(), info) ? zone.get_info(t + to_equivalent_year(date)) : info;
}

date::local_info zone_state(const date::time_zone& zone, date::local_seconds t) {
  const date::year_month_day date{date::floor<date::days>(t)};
  const auto info = zone.get_info(t);
  return beyond_zone_file(date.year(), info.first) ? zone.get_info(t + to_equivalent_year(date))
                                                   : info;
}

ClockChange clock_change(const date::local_info& info) {
  if (info.result == date::local_info::nonexistent) return ClockChange::skipped;
  if (info.result == date::local_info::ambiguous) return ClockChange::repeated;
  return ClockChange::none;
}

date::sys_seconds whole_seconds(UnixTime t) {
  return date::sys_seconds{seconds{static_cast<std::int64_t>(std::floor(t))}};
}

}  // namespace

TimeZone::TimeZone(const std::string& name) : name_(name) {
  if (name == "UTC" || name == "Z") return;
  if (const auto offset = parsed_offset_s(name)) {
    fixed_offset_s_ = *offset;
    return;
  }
  try {
    zone_ = date::locate_zone(name);
  } catch (const std::exception&) {
    throw InputError({}, "unknown time zone '" + name + "'",
                     "not in the system's time zone database",
                     "use an IANA name such as Europe/Prague, UTC, or a fixed offset such as "
                     "+01:00 (package tzdata must be installed)");
  }
}

ResolvedTime TimeZone::utc_from_civil(const CivilTime& civil) const {
  const UnixTime local = utc_from_calendar(civil);
  if (!zone_) return {local - fixed_offset_s_, ClockChange::none};
  const date::local_seconds reading{whole_seconds(local).time_since_epoch()};
  const auto info = zone_state(as_zone(zone_), reading);
  // `first` is the state before a change: a skipped reading is thereby moved forward by the
  // length of the gap, and a repeated one is taken as the first of the two.
  return {local - static_cast<double>(info.first.offset.count()), clock_change(info)};
}

CivilTime TimeZone::civil_from_utc(UnixTime utc) const {
  return calendar_from_utc(utc + offset_s(utc));
}

double TimeZone::offset_s(UnixTime utc) const {
  if (!zone_) return fixed_offset_s_;
  return static_cast<double>(zone_state(as_zone(zone_), whole_seconds(utc)).offset.count());
}

double TimeZone::standard_offset_s(int year) const {
  // The database's own flag will not do: in Dublin it calls winter time the special one.
  return std::min(offset_s(utc_from_calendar({.year = year, .month = 1, .day = 1})),
                  offset_s(utc_from_calendar({.year = year, .month = july, .day = 1})));
}

UnixTime utc_from_calendar(const CivilTime& utc) {
  const auto days = date::sys_days{year_month_day(utc)}.time_since_epoch().count();
  return static_cast<double>(days) * seconds_per_day + seconds_since_midnight(utc);
}

CivilTime calendar_from_utc(UnixTime utc) {
  SUNLOAD_EXPECT(std::isfinite(utc), "instant");
  double day = std::floor(utc / seconds_per_day);
  double rest = utc - day * seconds_per_day;
  if (rest >= seconds_per_day) {  // a tiny negative instant, rounded
    day += 1;
    rest = 0;
  }
  const date::sys_days date{date::days{static_cast<int>(day)}};
  const date::year_month_day ymd{date};
  const int hour = static_cast<int>(rest / seconds_per_hour);
  const int minute = static_cast<int>((rest - hour * seconds_per_hour) / seconds_per_minute);
  return {.year = static_cast<int>(ymd.year()),
          .month = static_cast<int>(static_cast<unsigned>(ymd.month())),
          .day = static_cast<int>(static_cast<unsigned>(ymd.day())),
          .hour = hour,
          .minute = minute,
          .second = rest - hour * seconds_per_hour - minute * seconds_per_minute};
}

int day_of_year(const CivilTime& date) {
  const date::year year{date.year};
  const auto days = date::sys_days{year_month_day(date)} - date::sys_days{year / date::January / 1};
  return days.count() + 1;
}

}  // namespace sunload
