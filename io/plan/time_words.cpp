// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/time_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sunload {

namespace {

constexpr double full_turn_deg = 360;

std::string interval_words(const LitInterval& interval, const TimeZone& zone) {
  const SunInterval& w = interval.when;
  return fmt::format("mean over {} to {}, sun at {} ({}): azimuth {:.2f} deg, elevation {:.2f} deg",
                     iso_local(w.begin, zone), iso_local(w.end, zone), iso_local(w.sun_time, zone),
                     iso_utc(w.sun_time), w.sun.azimuth_deg, w.sun.elevation_deg);
}

std::string place_words(const Site& site) {
  return fmt::format("{:.5f} deg {}, {:.5f} deg {}, {:.1f} m", std::abs(site.latitude_deg),
                     site.latitude_deg < 0 ? "south" : "north", std::abs(site.longitude_deg),
                     site.longitude_deg < 0 ? "west" : "east", site.elevation_m);
}

/// Beginning of the civil day that holds an instant.
UnixTime civil_day(UnixTime t, const TimeZone& zone) {
  const CivilTime civil = zone.civil_from_utc(t);
  return zone.utc_from_civil({civil.year, civil.month, civil.day, 0, 0, 0}).utc;
}

/// Beginnings of the civil days that hold these instants, each once, in order.
std::vector<UnixTime> civil_days(const std::vector<UnixTime>& times, const TimeZone& zone) {
  std::vector<UnixTime> days;
  for (const UnixTime t : times) {
    const UnixTime day = civil_day(t, zone);
    if (days.empty() || day > days.back()) days.push_back(day);
  }
  return days;
}

std::vector<UnixTime> sun_times(const LightSeries& light) {
  std::vector<UnixTime> times;
  for (const auto& i : light.intervals) times.push_back(i.when.sun_time);
  return times;
}

/// The first moment of another offset, between two instants that have different ones.
UnixTime change_between(UnixTime before, UnixTime after, const TimeZone& zone) {
  constexpr double exact_s = 0.5;
  const double old_offset_s = zone.offset_s(before);
  while (after - before > exact_s) {
    const UnixTime middle = (before + after) / 2;
    (zone.offset_s(middle) == old_offset_s ? before : after) = middle;
  }
  return std::round(after);
}

std::string clock_time(UnixTime utc, const TimeZone& zone) {
  constexpr double to_the_minute_s = seconds_per_minute / 2;
  const CivilTime civil = zone.civil_from_utc(utc + to_the_minute_s);
  return fmt::format("{:02}:{:02}", civil.hour, civil.minute);
}

/// "sunrise 06:07, sunset 18:21", or why there is neither.
std::string passages(const SunEvents& events, const char* up, const char* down,
                     const TimeZone& zone) {
  if (events.never_rises) return fmt::format("no {}, the sun stays too low", up);
  if (events.never_sets) return fmt::format("no {}, the sun stays high enough", down);
  std::string text;
  if (events.rise) text = fmt::format("{} {}", up, clock_time(*events.rise, zone));
  if (events.set)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", down, clock_time(*events.set, zone));
  return text;
}

/// Sunrise, noon, sunset and civil twilight on the civil day of an instant.
std::string day_words(const Site& site, UnixTime first, const TimeZone& zone,
                      const SunStudy& sun_study) {
  constexpr double civil_twilight_deg = -6;
  const UnixTime day = civil_day(first, zone);
  const SunEphemeris sun(day, day + seconds_per_day, site, sun_study.refraction, sun_study.ut1_utc,
                         standard_air(site.elevation_m));
  const SunEvents light = sun_events(sun, day), dusk = sun_events(sun, day, civil_twilight_deg);
  return fmt::format("{}: {} (upper limb at the sea's horizon), noon {}; civil twilight: {}",
                     iso_local(day, zone).substr(0, 10), passages(light, "sunrise", "sunset", zone),
                     clock_time(light.transit, zone), passages(dusk, "dawn", "dusk", zone));
}

std::string hills_words(const LightSeries& light, const Horizon& hills) {
  const auto& points = hills.points();
  const auto highest = std::max_element(points.begin(), points.end(), [](auto a, auto b) {
    return a.elevation_deg < b.elevation_deg;
  });
  std::size_t up = 0, hidden = 0;
  for (const auto& i : light.intervals) {
    if (i.when.up_s > 0) ++up;
    if (i.when.up_s > 0 && i.when.sunlit_s <= 0) ++hidden;
  }
  return fmt::format(
      "{} points, up to {:.2f} deg high at azimuth {:.1f} deg; {} of {} intervals with the sun up "
      "lie wholly behind them",
      points.size(), highest->elevation_deg, highest->azimuth_deg, hidden, up);
}

}  // namespace

std::string north_words(double north_deg) {
  const double turn_deg = std::remainder(north_deg, full_turn_deg);
  if (turn_deg == 0) return "the scene's +y axis points to true north";
  return fmt::format("the scene's +y axis points {:.3f} deg {} of true north", std::abs(turn_deg),
                     turn_deg > 0 ? "clockwise" : "counter-clockwise");
}

std::string clock_words(const LightSeries& light, const TimeZone& zone) {
  std::string text;
  for (const UnixTime day : civil_days(sun_times(light), zone)) {
    // 30 hours on it is the next day, however long this one is.
    const UnixTime next = civil_day(day + 1.25 * seconds_per_day, zone);
    // Some zones change at midnight, which then belongs to the day that it begins.
    const UnixTime before = day - 1, last = next - 1;
    if (zone.offset_s(before) == zone.offset_s(last)) continue;
    const UnixTime change = change_between(before, last, zone);
    const double step_s = zone.offset_s(last) - zone.offset_s(before);
    text += fmt::format("{}{} by {:g} min at {} ({:g} hours that day)", text.empty() ? "" : "; ",
                        step_s > 0 ? "forward" : "back", std::abs(step_s) / seconds_per_minute,
                        iso_local(change, zone), (next - day) / seconds_per_hour);
  }
  return text;
}

std::string pole_words(const Site& site, const std::vector<UnixTime>& times, const TimeZone& zone,
                       const SunStudy& sun_study) {
  constexpr double clear_shadow_deg = 5;  // below, the shadow is longer than 11 m
  SunPosition highest;
  UnixTime noon = 0;
  for (const UnixTime day : civil_days(times, zone)) {
    const SunEphemeris sun(day, day + seconds_per_day, site, sun_study.refraction,
                           sun_study.ut1_utc, standard_air(site.elevation_m));
    const UnixTime transit = sun_events(sun, day).transit;
    const SunPosition at_transit = sun(transit);
    if (noon != 0 && at_transit.elevation_deg <= highest.elevation_deg) continue;
    highest = at_transit;
    noon = transit;
    if (highest.elevation_deg > clear_shadow_deg) break;
  }
  if (noon == 0 || highest.elevation_deg <= 0)
    return "the sun stays below the horizon on all days of the period";
  const bool is_hidden = !site.horizon.is_above({highest.azimuth_deg, highest.elevation_deg});
  return fmt::format(
      "a 1 m pole on level ground casts {:.3f} m of shadow towards {:.1f} deg (clockwise from true "
      "north) at {}{}",
      1 / std::tan(radians(highest.elevation_deg)), wrapped_deg(highest.azimuth_deg + 180),
      iso_local(noon, zone), is_hidden ? ", if hills did not hide the sun then" : "");
}

std::string time_words(const LightSeries& light, const Site& site, const Study& study,
                       const std::string& site_source) {
  const TimeZone zone(study.site.timezone);
  std::string text;
  if (light.times_are_synthetic) {
    text = fmt::format("  {} sun positions without a date; time counts from 2000-01-01T12:00Z\n",
                       light.intervals.size());
  } else {
    text = fmt::format("  site       {} ({})\n", place_words(site), site_source);
    text += "  first      " + interval_words(light.intervals.front(), zone) + "\n";
    text += "  last       " + interval_words(light.intervals.back(), zone) + "\n";
    text += "  day        " +
            day_words(site, light.intervals.front().when.sun_time, zone, study.sun) + "\n";
    if (const auto clock = clock_words(light, zone); !clock.empty())
      text += "  clocks     " + clock + "\n";
  }
  for (std::size_t i = 0; i < light.weather.size(); ++i)
    text += (i == 0 ? "  weather    " : "             ") + light.weather[i] + "\n";
  if (!site.horizon.is_open()) text += "  hills      " + hills_words(light, site.horizon) + "\n";
  text += "  north      " + north_words(site.north_deg) + "\n";
  if (!light.times_are_synthetic)
    text += "  pole test  " + pole_words(site, sun_times(light), zone, study.sun) + "\n";
  return text;
}

}  // namespace sunload
