// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/sun/day_albedo.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

#include "geo/base/units.h"

namespace sunload {

namespace {

using Day = std::int64_t;  // of the calendar, counted through

Day civil_day(UnixTime begin, UnixTime end, const TimeZone& zone) {
  const UnixTime civil = utc_from_calendar(zone.civil_from_utc((begin + end) / 2));
  return static_cast<Day>(std::floor(civil / seconds_per_day));
}

/// Of a record on level ground, W m-2: GHI, else what DNI and DHI make of it in the middle of its
/// time.
double light_on_ground(const DatedWeather& record, const SineOfSun& sine_at) {
  const WeatherValues& values = record.values;
  if (values.ghi) return *values.ghi;
  const double dni = values.dni.value_or(0), dhi = values.dhi.value_or(0);
  if (dni <= 0) return dhi;
  return dhi + dni * std::max(0.0, sine_at((record.begin + record.end) / 2));
}

std::map<Day, double> means_by_day(const std::vector<DatedWeather>& weather, const TimeZone& zone,
                                   const SineOfSun& sine_at) {
  struct Sum {
    double weight = 0, albedo = 0;
  };
  std::map<Day, Sum> sums;
  for (const DatedWeather& record : weather) {
    const WeatherValues& values = record.values;
    if (!values.albedo) continue;
    const double light = light_on_ground(record, sine_at);
    if (light <= 0) continue;
    Sum& sum = sums[civil_day(record.begin, record.end, zone)];
    const double weight = light * (record.end - record.begin);
    sum.weight += weight;
    sum.albedo += weight * *values.albedo;
  }
  std::map<Day, double> means;
  for (const auto& [day, sum] : sums) means[day] = sum.albedo / sum.weight;
  return means;
}

double of_nearest(const std::map<Day, double>& means, Day day) {
  const auto next = means.lower_bound(day);
  if (next == means.begin()) return next->second;
  const auto before = std::prev(next);
  if (next == means.end() || day - before->first <= next->first - day) return before->second;
  return next->second;
}

}  // namespace

DayAlbedos day_albedos(const std::vector<DatedWeather>& weather, const SunPath& path,
                       const TimeZone& zone, const SineOfSun& sine_at) {
  DayAlbedos albedos;
  const auto means = means_by_day(weather, zone, sine_at);
  if (means.empty()) return albedos;
  std::set<Day> with_sun;
  albedos.of_interval.reserve(path.size());
  for (const SunInterval& interval : path) {
    const Day day = civil_day(interval.begin, interval.end, zone);
    albedos.of_interval.push_back(of_nearest(means, day));
    if (interval.up_s <= 0 || !with_sun.insert(day).second) continue;
    ++albedos.days;
    if (!means.contains(day)) ++albedos.filled;
  }
  return albedos;
}

}  // namespace sunload
