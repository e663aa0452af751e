// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/measure/sun_day.h"

#include <cmath>
#include <utility>

#include "geo/base/units.h"
#include "geo/time/change_of.h"

namespace sunload {

namespace {

double number_or_zero(const MeasureParameters& of, const std::string& key) {
  const auto found = of.numbers.find(key);
  return found == of.numbers.end() ? 0 : found->second;
}

/// Midnight to midnight: 23, 24 or 25 hours.
SunSpan civil_day(const CivilTime& date, const std::string& timezone) {
  const TimeZone zone(timezone);
  const CivilTime midnight{date.year, date.month, date.day};
  const UnixTime begin = zone.utc_from_civil(midnight).utc;
  constexpr double to_next_noon_s = 1.5 * seconds_per_day;
  const CivilTime next = zone.civil_from_utc(begin + to_next_noon_s);
  return {begin, zone.utc_from_civil({next.year, next.month, next.day}).utc};
}

class SunDay : public Measure {
 public:
  SunDay(MeasureParameters parameters, const MeasuredScene& scene)
      : parameters_(std::move(parameters)), scene_(scene) {}

  MeasureValues values() override {
    const SunCourse course =
        sun_course(scene_, *parameters_.date, number_or_zero(parameters_, "least_elevation_deg"));
    auto spans = sunlit_spans(scene_.points, scene_.caster, course,
                              {number_or_zero(parameters_, "least_angle_deg"),
                               number_or_zero(parameters_, "least_plan_angle_deg")});
    const double least_s = seconds_per_minute * number_or_zero(parameters_, "least_span_min");
    const auto count = parameters_.words.find("count");
    const bool only_longest = count != parameters_.words.end() && count->second == "longest";
    MeasureValues found;
    for (const auto& of_point : spans) {
      const SunSpan one = longest(of_point);
      const double counted = one.length_s() < least_s ? 0 : one.length_s();
      found.value.push_back((only_longest ? counted : total_s(of_point, least_s)) /
                            seconds_per_hour);
    }
    found.spans = std::move(spans);
    return found;
  }

 private:
  MeasureParameters parameters_;
  const MeasuredScene& scene_;
};

}  // namespace

SunCourse sun_course(const MeasuredScene& scene, const CivilTime& date,
                     double least_elevation_deg) {
  return sun_course(scene.site, scene.refraction, scene.ut1, date, least_elevation_deg);
}

SunCourse sun_course(const Site& site, Refraction refraction, Ut1 ut1, const CivilTime& date,
                     double least_elevation_deg) {
  const SunSpan day = civil_day(date, site.timezone);
  const auto sun = std::make_shared<const SunEphemeris>(day.begin, day.end, site, refraction, ut1,
                                                        standard_air(site.elevation_m));
  const Rotation scene_axes = scene_from_enu(site);
  const auto counts = [&](UnixTime t) {
    const SunPosition at = (*sun)(t);
    return at.elevation_deg > 0 && at.elevation_deg >= least_elevation_deg &&
           (site.horizon.is_open() || site.horizon.is_above({at.azimuth_deg, at.elevation_deg}));
  };
  SunCourse course;
  course.direction = [sun, scene_axes](double t) {
    const SunPosition at = (*sun)(t);
    return scene_axes(enu_direction({at.azimuth_deg, at.elevation_deg}));
  };
  const int steps = static_cast<int>(std::ceil((day.end - day.begin) / seconds_per_minute));
  UnixTime before = day.begin;
  bool counted = counts(before);
  if (counted) course.counted.push_back(day);
  for (int i = 1; i <= steps; ++i) {
    const UnixTime t = i < steps ? day.begin + i * seconds_per_minute : day.end;
    if (counts(t) != counted) {
      const UnixTime change = change_of(counts, before, t);
      if (counted)
        course.counted.back().end = change;
      else
        course.counted.push_back({change, day.end});
      counted = !counted;
    }
    before = t;
  }
  return course;
}

std::unique_ptr<Measure> start_sun_day(const MeasureParameters& parameters,
                                       const MeasuredScene& scene) {
  return std::make_unique<SunDay>(parameters, scene);
}

}  // namespace sunload
