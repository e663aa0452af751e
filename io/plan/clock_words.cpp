// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/clock_words.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "geo/base/units.h"
#include "geo/time/time.h"
#include "io/study/words.h"

namespace sunload {

namespace {

constexpr double worth_a_note_s = 15 * seconds_per_minute;
/// Half an hour off are many files of formats that have a stamp of their own: hours of satellites
/// and models name their middle. Of a CSV the study says it.
constexpr double telling_s = 35 * seconds_per_minute;
constexpr double telling_of_csv_s = 25 * seconds_per_minute;
/// Between a shift and what would explain it.
constexpr double same_shift_s = 12 * seconds_per_minute;

long minutes(double seconds) { return std::lround(seconds / seconds_per_minute); }

/// "over 201 clear days its light comes 59 min later than the sun (half of the days: 53 to 61 min)"
std::string shift_words(const ClockShift& shift) {
  const bool is_late = shift.whole.median > 0;
  const double nearer = is_late ? shift.whole.lower : -shift.whole.upper;
  const double farther = is_late ? shift.whole.upper : -shift.whole.lower;
  return fmt::format(
      "over {} clear days its light comes {} min {} than the sun of its stamps (half of these "
      "days: {} to {} min)",
      shift.days, minutes(std::abs(shift.whole.median)), is_late ? "later" : "earlier",
      minutes(nearer), minutes(farther));
}

/// `light.stamp: end`, where another stamp would take the shift away.
std::string stamp_words(double shift_s, double step_s, Stamp stamp) {
  for (const auto& [name, other] : words_of(Stamp{})) {
    const double earlier_s = (static_cast<int>(other) - static_cast<int>(stamp)) * step_s / 2;
    if (other != stamp && std::abs(shift_s - earlier_s) <= same_shift_s)
      return fmt::format("light.stamp: {}", name);
  }
  return {};
}

/// A clock of another zone, where one would take the shift away.
std::string zone_words(double shift_s, double offset_s, const WeatherFile& file) {
  constexpr double zones_apart_s = seconds_per_hour / 2;
  const double steps = std::round(shift_s / zones_apart_s);
  if (std::abs(shift_s - steps * zones_apart_s) > same_shift_s || std::abs(steps) < 2) return {};
  const std::string zone = offset_text(offset_s + steps * zones_apart_s);
  if (file.format == "CSV" && !file.offset_s)
    return fmt::format("a line '# utc_offset: {}' above its columns (site.timezone has UTC{})",
                       zone, offset_text(offset_s));
  const char* where = file.format == "EPW"    ? "LOCATION"
                      : file.format == "WEA"  ? "time_zone"
                      : file.format == "TMY3" ? "its first line"
                                              : "'# utc_offset' or the offsets of its rows";
  return fmt::format("UTC{} in place of UTC{} in {}", zone, offset_text(offset_s), where);
}

std::string advice(double shift_s, const WeatherFile& file, double offset_s) {
  const WeatherRecord& first = file.records.front();
  const std::string other_stamp =
      file.format == "EPW" ? std::string()
                           : stamp_words(shift_s, first.end_s - first.begin_s, file.stamp);
  const std::string zone = zone_words(shift_s, offset_s, file);
  if (other_stamp.empty() && zone.empty())
    return "are stamp, time zone and longitude of the weather right?";
  return "what would fit: " + other_stamp + (other_stamp.empty() || zone.empty() ? "" : ", or ") +
         zone;
}

/// Of clocks that are advanced in summer.
std::string summer_words(const WeatherClock& clock, const WeatherFile& file) {
  return fmt::format(
      "weather: its light comes {} min later in summer than in winter ({} and {} clear days), as "
      "if its stamps kept daylight saving time, where local standard time is read: the suns of all "
      "its summer are off by as much; write standard time{}",
      minutes(clock.summer.whole.median - clock.winter.whole.median), clock.summer.days,
      clock.winter.days,
      file.format == "CSV" ? ", or offsets from UTC such as +02:00 in each row" : "");
}

}  // namespace

WeatherSayings clock_words(const WeatherClock& clock, const WeatherFile& file, double offset_s) {
  WeatherSayings said;
  const bool has_summer_time = clock.has_summer_time();
  if (has_summer_time) said.warnings.push_back(summer_words(clock, file));
  const ClockShift& shift = has_summer_time ? clock.winter : clock.all;
  const std::string text = shift_words(shift);
  if (shift.exceeds(file.format == "CSV" ? telling_of_csv_s : telling_s))
    said.warnings.push_back(fmt::format(
        "weather: {}{}: shadows, and east and west, are wrong by as much; {}",
        has_summer_time ? "in winter " : "", text, advice(shift.whole.median, file, offset_s)));
  else if (!has_summer_time && shift.exceeds(worth_a_note_s))
    said.notes.push_back(text);
  return said;
}

}  // namespace sunload
