// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Sunrise and sunset, and the representative suns of a period.
#include <algorithm>
#include <cmath>
#include <vector>

#include "geo/base/check.h"
#include "geo/sun/sun.h"
#include "geo/time/change_of.h"

namespace sunload {

namespace {

using Sense = ElevationCrossing::Sense;

// Steps of the search. The elevation's extremes are half a day apart, so a step holds one at most.
constexpr double search_step_s = 1800;
// The sky turns by 360.99° a day, the sun's own motion changes nothing of note.
constexpr double fastest_deg_per_s = 15.1 / 3600;
// Half the baseline of slopes: 0.004° of motion, a million times the rounding.
constexpr double slope_step_s = 1;

/// Search for passages over a span, one step at a time.
class CrossingSearch {
 public:
  CrossingSearch(const SunEphemeris& sun, double threshold_deg)
      : sun_(sun), threshold_deg_(threshold_deg) {}

  std::vector<ElevationCrossing> operator()(UnixTime begin, UnixTime end) {
    const auto steps = static_cast<int>(std::ceil((end - begin) / search_step_s));
    UnixTime a = begin;
    double height_a = height_deg(a);
    for (int i = 1; i <= steps; ++i) {
      const UnixTime b = i < steps ? begin + (end - begin) * i / steps : end;
      const double height_b = height_deg(b);
      step(a, height_a, b, height_b);
      a = b;
      height_a = height_b;
    }
    return std::move(found_);
  }

 private:
  double height_deg(UnixTime t) const { return sun_(t).true_elevation_deg - threshold_deg_; }
  bool above(UnixTime t) const { return height_deg(t) > 0; }
  bool rising(UnixTime t) const {
    return height_deg(t + slope_step_s) > height_deg(t - slope_step_s);
  }

  void step(UnixTime a, double height_a, UnixTime b, double height_b) {
    if ((height_a > 0) != (height_b > 0)) {
      add(a, b);
      return;
    }
    // The same side at both ends: the sun may have dipped across and back, if near enough.
    const double reach_deg = fastest_deg_per_s * (b - a);
    if (std::min(std::abs(height_a), std::abs(height_b)) > reach_deg) return;
    const bool rising_a = rising(a), rising_b = rising(b);
    const bool extreme_towards_threshold =
        height_a > 0 ? !rising_a && rising_b : rising_a && !rising_b;
    if (!extreme_towards_threshold) return;
    const UnixTime extreme = change_of([&](UnixTime t) { return rising(t); }, a, b);
    if (above(extreme) == (height_a > 0)) return;
    add(a, extreme);
    add(extreme, b);
  }

  void add(UnixTime a, UnixTime b) {
    const Sense sense = above(a) ? Sense::down : Sense::up;
    found_.push_back({change_of([&](UnixTime t) { return above(t); }, a, b), sense});
  }

  const SunEphemeris& sun_;
  double threshold_deg_;
  std::vector<ElevationCrossing> found_;
};

// Component of the sun's direction to the east: the sun is on the meridian where it vanishes.
double eastward(const SunPosition& sun) {
  return enu_direction({sun.azimuth_deg, sun.true_elevation_deg}).x;
}

UnixTime upper_transit(const SunEphemeris& sun, UnixTime day_begin) {
  // Solar days differ from 24 h by half a minute, so that a day may just miss its transit.
  constexpr double margin_s = 60, step_s = 3600;
  const auto in_the_east = [&](UnixTime t) { return eastward(sun(t)) > 0; };
  const UnixTime begin = day_begin - margin_s, end = day_begin + seconds_per_day + margin_s;
  bool east = in_the_east(begin);
  for (int step = 0; begin + step * step_s < end; ++step) {
    const UnixTime a = begin + step * step_s, b = std::min(a + step_s, end);
    const bool still_east = in_the_east(b);
    if (east && !still_east) return change_of(in_the_east, a, b);
    east = still_east;
  }
  contract_failed("a transit a day", __FILE__, __LINE__, iso_utc(day_begin));
}

struct Part {
  UnixTime begin = 0, end = 0;
  double length_s() const { return end - begin; }
};

// What of a step has the sun's centre above a true elevation, in order.
std::vector<Part> parts_up(const SunEphemeris& sun, const PeriodStep& step, double sunlit_above) {
  std::vector<Part> parts;
  if (sun(step.begin).true_elevation_deg > sunlit_above) parts.push_back({step.begin, step.end});
  for (const auto& crossing : elevation_crossings(sun, step.begin, step.end, sunlit_above)) {
    if (crossing.sense == Sense::up) {
      parts.push_back({crossing.time, step.end});
    } else {
      parts.back().end = crossing.time;
    }
  }
  return parts;
}

// What of these parts has the sun's centre above the line of the hills.
std::vector<Part> parts_above(const Horizon& hills, const SunEphemeris& sun,
                              const std::vector<Part>& up) {
  // The sun moves by a quarter of a degree meanwhile: finer than horizon files are.
  constexpr double step_s = 60;
  const auto above = [&](UnixTime t) {
    const SunPosition now = sun(t);
    return hills.is_above({now.azimuth_deg, now.elevation_deg});
  };
  std::vector<Part> parts;
  for (const Part& part : up) {
    const auto steps = static_cast<int>(std::ceil(part.length_s() / step_s));
    UnixTime a = part.begin;
    bool above_a = above(a);
    if (above_a) parts.push_back(part);
    for (int i = 1; i <= steps; ++i) {
      const UnixTime b = i < steps ? part.begin + part.length_s() * i / steps : part.end;
      const bool above_b = above(b);
      if (above_b != above_a) {
        const UnixTime change = change_of(above, a, b);
        if (above_b) parts.push_back({change, part.end});
        if (!above_b) parts.back().end = change;
      }
      a = b;
      above_a = above_b;
    }
  }
  return parts;
}

struct Hull {
  UnixTime begin = 0, end = 0;
  double lit_s = 0;
};

Hull hull(const std::vector<Part>& parts, UnixTime of_none) {
  if (parts.empty()) return {of_none, of_none, 0};
  Hull hull{parts.front().begin, parts.back().end, 0};
  for (const auto& part : parts) hull.lit_s += part.length_s();
  return hull;
}

UnixTime middle_of_longest(const std::vector<Part>& parts) {
  const Part& longest = *std::max_element(
      parts.begin(), parts.end(), [](Part a, Part b) { return a.length_s() < b.length_s(); });
  return longest.begin + longest.length_s() / 2;
}

UnixTime representative(const PeriodStep& step, const std::vector<Part>& sunlit,
                        const std::vector<Part>& up) {
  if (step.rule == SunInstant::given) return step.instant;
  if (!sunlit.empty()) return middle_of_longest(sunlit);
  if (!up.empty()) return middle_of_longest(up);
  return step.begin + (step.end - step.begin) / 2;
}

/// When so much sun of these parts is over.
UnixTime after_sun(const std::vector<Part>& parts, double sun_s) {
  for (const Part& part : parts) {
    if (sun_s <= part.length_s()) return part.begin + sun_s;
    sun_s -= part.length_s();
  }
  return parts.back().end;
}

/// What positions of the sun are asked of, and by which rules.
struct Watch {
  const SunEphemeris& sun;
  double sunlit_above_deg;
  const Horizon& hills;
  const Rotation& scene_axes;
  const SunSamples& samples;

  Vec3 direction(const SunPosition& of) const {
    return scene_axes(enu_direction({of.azimuth_deg, of.elevation_deg}));
  }
};

std::vector<Vec3> sun_samples(const PeriodStep& step, const std::vector<Part>& sunlit,
                              double sunlit_s, const Watch& watch) {
  if (step.rule == SunInstant::given || sunlit.empty()) return {};
  const int count = sun_sample_count(watch.samples, sunlit_s);
  if (count == 1) return {};
  std::vector<Vec3> samples;
  samples.reserve(static_cast<std::size_t>(count));
  for (int s = 0; s < count; ++s)
    samples.push_back(watch.direction(watch.sun(after_sun(sunlit, sunlit_s * (s + 0.5) / count))));
  return samples;
}

SunInterval interval_of(const PeriodStep& step, const Watch& watch) {
  const SunEphemeris& sun = watch.sun;
  const Horizon& hills = watch.hills;
  const auto up = parts_up(sun, step, watch.sunlit_above_deg);
  auto sunlit = hills.is_open() ? up : parts_above(hills, sun, up);
  SunInterval interval;
  interval.begin = step.begin;
  interval.end = step.end;
  interval.sun_time = representative(step, sunlit, up);
  interval.sun = sun(interval.sun_time);
  const Horizontal place{interval.sun.azimuth_deg, interval.sun.elevation_deg};
  // The sun of an instant stands where it stands: light of other minutes does not come from there.
  if (step.rule == SunInstant::given &&
      (interval.sun.true_elevation_deg <= watch.sunlit_above_deg || !hills.is_above(place)))
    sunlit.clear();
  const Hull lit = hull(sunlit, interval.sun_time), open = hull(up, interval.sun_time);
  interval.sunlit_s = lit.lit_s;
  interval.sunlit_begin = lit.begin;
  interval.sunlit_end = lit.end;
  interval.up_s = open.lit_s;
  interval.up_begin = open.begin;
  interval.up_end = open.end;
  interval.direction = watch.direction(interval.sun);
  interval.sun_samples = sun_samples(step, sunlit, lit.lit_s, watch);
  return interval;
}

void expect_in_order(const std::vector<PeriodStep>& steps) {
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const PeriodStep& step = steps[i];
    SUNLOAD_EXPECT(std::isfinite(step.begin) && std::isfinite(step.end) && step.begin < step.end,
                   "bounds of a step");
    SUNLOAD_EXPECT(i == 0 || steps[i - 1].begin < step.begin, "order of steps");
    SUNLOAD_EXPECT(
        step.rule != SunInstant::given || (step.instant >= step.begin && step.instant <= step.end),
        "instant within its step");
  }
}

}  // namespace

std::vector<ElevationCrossing> elevation_crossings(const SunEphemeris& sun, UnixTime begin,
                                                   UnixTime end, double true_elevation_deg) {
  return CrossingSearch(sun, true_elevation_deg)(begin, end);
}

SunEvents sun_events(const SunEphemeris& sun, UnixTime day_begin, double true_elevation_deg) {
  SunEvents events;
  const auto crossings =
      elevation_crossings(sun, day_begin, day_begin + seconds_per_day, true_elevation_deg);
  for (const auto& crossing : crossings) {
    auto& event = crossing.sense == Sense::up ? events.rise : events.set;
    if (!event) event = crossing.time;
  }
  if (crossings.empty()) {
    events.never_sets = sun(day_begin).true_elevation_deg > true_elevation_deg;
    events.never_rises = !events.never_sets;
  }
  events.transit = upper_transit(sun, day_begin);
  return events;
}

int sun_sample_count(const SunSamples& samples, double sunlit_s) {
  constexpr double longest_s = 20 * seconds_per_minute;
  constexpr double rounding_s = 1e-3;  // of the bounds, which are seconds since 1970
  if (samples.count) return std::max(*samples.count, 1);
  return std::max(1, static_cast<int>(std::ceil((sunlit_s - rounding_s) / longest_s)));
}

SunPath sun_path(const std::vector<PeriodStep>& steps, const Site& site, Refraction refraction,
                 Ut1 ut1, const SunSamples& samples) {
  if (steps.empty()) return {};
  expect_in_order(steps);
  UnixTime end = steps.back().end;
  for (const auto& step : steps) end = std::max(end, step.end);
  const Air air = standard_air(site.elevation_m);
  const SunEphemeris sun(steps.front().begin, end, site, refraction, ut1, air);
  const double sunlit_above = sunlit_above_deg(refraction, air);
  const Rotation scene_axes = scene_from_enu(site);

  SunPath path;
  path.reserve(steps.size());
  const Watch watch{sun, sunlit_above, site.horizon, scene_axes, samples};
  for (const auto& step : steps) path.push_back(interval_of(step, watch));
  return path;
}

}  // namespace sunload
