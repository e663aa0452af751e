// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/time/period_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "geo/base/units.h"

namespace sunload {

namespace {

/// Times closer together are one: instants are whole parts of seconds, told as doubles.
constexpr double instant_s = 1e-3;

/// Where in the list of parts an instant belongs, and until when that is so.
struct Place {
  std::int64_t key = 0;
  UnixTime end = 0;
};

UnixTime begin_of_month(int year, int month, const TimeZone& zone) {
  constexpr int months = 12;
  CivilTime first;
  first.year = year + (month - 1) / months;
  first.month = (month - 1) % months + 1;
  return zone.utc_from_civil(first).utc;
}

/// Midnight that begins the civil day which is `later` days after that of `at`.
UnixTime midnight(const CivilTime& at, int later, const TimeZone& zone) {
  CivilTime noon = at;
  noon.hour = 12;
  noon.minute = 0;
  noon.second = 0;
  CivilTime day = calendar_from_utc(utc_from_calendar(noon) + later * seconds_per_day);
  day.hour = 0;
  return zone.utc_from_civil(day).utc;
}

/// The full hour of the clock that comes next. Where clocks change before it, that instant.
UnixTime end_of_hour(UnixTime t, const TimeZone& zone) {
  const double offset = zone.offset_s(t), local = t + offset;
  UnixTime end =
      (std::floor((local + instant_s) / seconds_per_hour) + 1) * seconds_per_hour - offset;
  if (zone.offset_s(end - instant_s) == offset) return end;
  UnixTime begin = t;
  while (end - begin > instant_s) {
    const UnixTime middle = (begin + end) / 2;
    (zone.offset_s(middle) == offset ? begin : end) = middle;
  }
  return std::round(end);
}

Place place_of(PartKind kind, UnixTime t, const TimeZone& zone, double latitude_deg) {
  const CivilTime at = zone.civil_from_utc(t + instant_s);
  constexpr int base = 100;  // more than months, days and hours have numbers
  switch (kind) {
    case PartKind::month:
      return {at.year * base + at.month, begin_of_month(at.year, at.month + 1, zone)};
    case PartKind::season:
      return {static_cast<std::int64_t>(season_of(at.month, latitude_deg)),
              begin_of_month(at.year, at.month + 1, zone)};
    case PartKind::day:
      return {(at.year * base + at.month) * base + at.day, midnight(at, 1, zone)};
    case PartKind::hour_of_day:
      break;
  }
  return {at.hour, end_of_hour(t, zone)};
}

/// A part without intervals, as it is called.
PeriodPart named_part(PartKind kind, std::int64_t key, UnixTime within, const TimeZone& zone) {
  const CivilTime at = zone.civil_from_utc(within + instant_s);
  PeriodPart part;
  switch (kind) {
    case PartKind::month:
      part.label = fmt::format("{:04}-{:02}", at.year, at.month);
      part.bounds = {begin_of_month(at.year, at.month, zone),
                     begin_of_month(at.year, at.month + 1, zone)};
      break;
    case PartKind::season:
      part.label = season_names[static_cast<std::size_t>(key)];
      break;
    case PartKind::day:
      part.label = fmt::format("{:04}-{:02}-{:02}", at.year, at.month, at.day);
      part.bounds = {midnight(at, 0, zone), midnight(at, 1, zone)};
      break;
    case PartKind::hour_of_day:
      part.label = std::to_string(key);
      break;
  }
  return part;
}

void add(PeriodPart& part, std::size_t interval, double duration_s, double length_s) {
  part.duration_s += duration_s;
  if (part.intervals.empty() || part.intervals.back().interval != interval)
    part.intervals.push_back({interval, 0});
  part.intervals.back().share += duration_s / length_s;
}

}  // namespace

std::size_t season_of(int month, double latitude_deg) {
  constexpr int months = 12, of_season = 3, first_of_spring = 3, half_a_year = 6;
  const int shift = latitude_deg < 0 ? half_a_year : 0;
  return static_cast<std::size_t>((month + shift + months - first_of_spring) % months / of_season);
}

std::vector<TimeSpan> clock_hours(TimeSpan time, const TimeZone& zone) {
  std::vector<TimeSpan> hours;
  for (UnixTime t = time[0]; t < time[1];) {
    const UnixTime end = end_of_hour(t, zone);
    const UnixTime until = end > time[1] - instant_s ? time[1] : std::max(end, t + instant_s);
    hours.push_back({t, until});
    t = until;
  }
  return hours;
}

namespace {

/// Parts in the order of their keys: `place_at(t)` is where an instant belongs, `empty_part(key,
/// t)` the part that it begins.
template <class PlaceAt, class EmptyPart>
std::vector<PeriodPart> sorted_parts(const std::vector<TimeSpan>& intervals,
                                     const PlaceAt& place_at, const EmptyPart& empty_part) {
  std::map<std::int64_t, PeriodPart> parts;
  Place place;
  UnixTime known_from = 0;  // `place` holds from here to its end
  for (std::size_t k = 0; k < intervals.size(); ++k) {
    const auto [begin, end] = intervals[k];
    for (UnixTime t = begin; t < end;) {
      if (!(t >= known_from && t < place.end - instant_s)) {
        place = place_at(t);
        known_from = t;
      }
      // What is left of a part beyond a rounding belongs to the interval.
      const UnixTime until = place.end > end - instant_s ? end : std::max(place.end, t + instant_s);
      auto [part, is_new] = parts.try_emplace(place.key);
      if (is_new) part->second = empty_part(place.key, t);
      add(part->second, k, until - t, end - begin);
      t = until;
    }
  }
  std::vector<PeriodPart> sorted;
  sorted.reserve(parts.size());
  for (auto& [key, part] : parts) sorted.push_back(std::move(part));
  return sorted;
}

/// The step of the day that an instant lies in.
TimeSpan clock_step(double step_s, UnixTime t, const TimeZone& zone) {
  const CivilTime at = zone.civil_from_utc(t + instant_s);
  const UnixTime begin_of_day = midnight(at, 0, zone), end_of_day = midnight(at, 1, zone);
  const UnixTime begin =
      begin_of_day + std::floor((t + instant_s - begin_of_day) / step_s) * step_s;
  return {begin, std::min(begin + step_s, end_of_day)};
}

}  // namespace

PeriodDivision divided(PartKind kind, const std::vector<TimeSpan>& intervals, const TimeZone& zone,
                       double latitude_deg) {
  return {kind, sorted_parts(
                    intervals, [&](UnixTime t) { return place_of(kind, t, zone, latitude_deg); },
                    [&](std::int64_t key, UnixTime t) { return named_part(kind, key, t, zone); })};
}

std::vector<PeriodPart> clock_steps(double step_s, const std::vector<TimeSpan>& intervals,
                                    const TimeZone& zone) {
  return sorted_parts(
      intervals,
      [&](UnixTime t) {
        const TimeSpan step = clock_step(step_s, t, zone);
        return Place{static_cast<std::int64_t>(std::llround(step[0])), step[1]};
      },
      [&](std::int64_t, UnixTime t) {
        PeriodPart part;
        part.bounds = clock_step(step_s, t, zone);
        return part;
      });
}

}  // namespace sunload
