// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/period.h"

#include <algorithm>
#include <cmath>

#include "geo/sun/site.h"

namespace sunload {

namespace {

/// 2000-01-01T12:00:00Z: where positions without a date begin.
constexpr UnixTime synthetic_epoch = 946728000;

/// "2026-03-29 02:30".
std::string clock_reading(const CivilTime& civil) {
  std::string text = iso_utc(utc_from_calendar(civil));
  text.pop_back();
  text.replace(text.find('T'), 1, " ");
  return text.ends_with(":00") ? text.substr(0, text.size() - 3) : text;
}

UnixTime resolved(const CivilTime& civil, const TimeZone& zone, std::vector<std::string>& notes) {
  const ResolvedTime time = zone.utc_from_civil(civil);
  if (time.change == ClockChange::none) return time.utc;
  const bool is_skipped = time.change == ClockChange::skipped;
  notes.push_back(clock_reading(civil) + (is_skipped ? " is skipped in " : " occurs twice in ") +
                  zone.name() + ", where clocks change then; taken as " +
                  (is_skipped ? "" : "the first, ") + iso_local(time.utc, zone));
  return time.utc;
}

}  // namespace

UnixTime utc_of(const ParsedTime& time, const TimeZone& zone, std::vector<std::string>& notes) {
  if (time.has_offset) return utc_from_calendar(time.civil) - time.offset_s;
  return resolved(time.civil, zone, notes);
}

namespace {

/// Midnight of a day plus a time of day; 24:00 is the next midnight.
CivilTime at_time_of_day(CivilTime day, double seconds) {
  day.hour = day.minute = 0;
  day.second = 0;
  return calendar_from_utc(utc_from_calendar(day) + seconds);
}

void append_steps(UnixTime begin, UnixTime end, double step_s, std::vector<PeriodStep>& steps) {
  // A step shorter than this is rounding of the calendar, no step of the user.
  constexpr double shortest_step_s = 1e-3;
  for (std::size_t n = 0;; ++n) {
    const UnixTime from = begin + static_cast<double>(n) * step_s;
    if (end - from < shortest_step_s) return;
    const UnixTime to = std::min(end, from + step_s);
    steps.push_back({from, to, (from + to) / 2, SunInstant::middle_of_sunlit_part});
  }
}

struct StepsOf {
  const TimeZone& zone;
  PeriodSteps& out;

  void operator()(const DaysPeriod& period) const {
    for (const auto& day : period.days)
      append_steps(at(day, period.from_s), at(day, period.to_s),
                   period.step_min * seconds_per_minute, out.steps);
  }
  /// Of days that begin or end where clocks change there is nothing to be said: no such time is
  /// written.
  UnixTime at(const CivilTime& day, double time_of_day_s) const {
    std::vector<std::string> unsaid;
    const bool is_midnight = time_of_day_s == 0 || time_of_day_s == seconds_per_day;
    return resolved(at_time_of_day(day, time_of_day_s), zone, is_midnight ? unsaid : out.notes);
  }
  void operator()(const RangePeriod& period) const {
    append_steps(utc_of(period.start, zone, out.notes), utc_of(period.end, zone, out.notes),
                 period.step_min * seconds_per_minute, out.steps);
  }
  void operator()(const InstantsPeriod& period) const {
    const double half = period.interval_min * seconds_per_minute / 2;
    for (const auto& instant : period.instants) {
      const UnixTime t = utc_of(instant, zone, out.notes);
      out.steps.push_back({t - half, t + half, t, SunInstant::given});
    }
  }
  void operator()(const PositionsPeriod&) const {}
  void operator()(const WeatherPeriod&) const {}  // its steps are those of the file
};

}  // namespace

PeriodSteps period_steps(const PeriodStudy& period, const TimeZone& zone) {
  PeriodSteps out;
  std::visit(StepsOf{zone, out}, period.kind);
  for (std::size_t i = 1; i < out.steps.size(); ++i)
    if (out.steps[i].instant <= out.steps[i - 1].instant)
      throw InputError(period.where,
                       "period: " + iso_utc(out.steps[i].instant) + " does not come after " +
                           iso_utc(out.steps[i - 1].instant),
                       "time must strictly increase", "sort the days or instants, name each once");
  return out;
}

SunPath positions_path(const PositionsPeriod& period, const Site& site) {
  const Rotation scene_axes = scene_from_enu(site);
  SunPath path;
  UnixTime begin = synthetic_epoch;
  for (const auto& at : period.positions) {
    SunInterval interval;
    interval.begin = begin;
    interval.end = begin + at.interval_min * seconds_per_minute;
    interval.sun_time = (interval.begin + interval.end) / 2;
    interval.sun = {at.azimuth_deg, at.elevation_deg, at.elevation_deg, 1};
    interval.direction = scene_axes(enu_direction({at.azimuth_deg, at.elevation_deg}));
    const bool is_up = at.elevation_deg > 0;
    interval.up_s = is_up ? interval.length_s() : 0;
    interval.up_begin = is_up ? interval.begin : interval.sun_time;
    interval.up_end = is_up ? interval.end : interval.sun_time;
    const bool is_sunlit = is_up && site.horizon.is_above({at.azimuth_deg, at.elevation_deg});
    interval.sunlit_s = is_sunlit ? interval.up_s : 0;
    interval.sunlit_begin = is_sunlit ? interval.up_begin : interval.sun_time;
    interval.sunlit_end = is_sunlit ? interval.up_end : interval.sun_time;
    path.push_back(interval);
    begin = interval.end;
  }
  return path;
}

}  // namespace sunload
