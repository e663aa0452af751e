// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/sun/weather_holes.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "geo/base/units.h"

namespace sunload {

namespace {

int whole_days_in(UnixTime begin, UnixTime end, double offset_s) {
  const double first = std::ceil((begin + offset_s) / seconds_per_day);
  const double last = std::floor((end + offset_s) / seconds_per_day);
  return static_cast<int>(std::max(0.0, last - first));
}

bool is_within_a_day(UnixTime begin, UnixTime end, double offset_s) {
  return std::ceil((end + offset_s) / seconds_per_day) -
             std::floor((begin + offset_s) / seconds_per_day) <=
         1;
}

bool has_sun(const WeatherHole& hole, const SunEphemeris& sun) {
  for (UnixTime at = hole.begin; at < hole.end; at += seconds_per_hour)
    if (sun(at).elevation_deg > 0) return true;
  return false;
}

/// Nothing where no record would have sun from its beginning to its end.
std::vector<DatedWeather> sunlit_records(const WeatherHole& hole, double count,
                                         const SunEphemeris& sun) {
  const double length = (hole.end - hole.begin) / count;
  const auto is_up = [&](UnixTime at) { return sun(at).elevation_deg > 0; };
  std::vector<DatedWeather> records;
  bool is_any_whole = false;
  for (double k = 0; k < count; ++k) {
    const UnixTime begin = hole.begin + k * length, end = begin + length;
    if (!is_up((begin + end) / 2)) continue;
    records.push_back({begin, end, {}, hole.line});
    is_any_whole = is_any_whole || (is_up(begin) && is_up(end));
  }
  return is_any_whole ? records : std::vector<DatedWeather>();
}

}  // namespace

std::vector<WeatherHole> sunlit_holes(const std::vector<DatedWeather>& weather,
                                      const SunEphemeris& sun, double longitude_deg) {
  constexpr double seconds_per_degree = seconds_per_day / 360;
  const double offset_s = longitude_deg * seconds_per_degree;
  std::vector<WeatherHole> holes;
  for (std::size_t i = 1; i < weather.size(); ++i) {
    const DatedWeather &before = weather[i - 1], &behind = weather[i];
    const double count = std::round((behind.begin - before.end) / (before.end - before.begin));
    if (!(count >= 1)) continue;
    WeatherHole hole{before.end,
                     behind.begin,
                     behind.line,
                     whole_days_in(before.end, behind.begin, offset_s),
                     {}};
    auto records = hole.whole_days == 0 ? sunlit_records(hole, count, sun) : hole.records;
    if (hole.whole_days == 0 ? records.empty() : !has_sun(hole, sun)) continue;
    if (is_within_a_day(hole.begin, hole.end, offset_s)) hole.records = std::move(records);
    holes.push_back(std::move(hole));
  }
  return holes;
}

std::vector<DatedWeather> with_records_of(const std::vector<WeatherHole>& holes,
                                          const std::vector<DatedWeather>& weather) {
  std::vector<DatedWeather> more;
  for (const auto& hole : holes) more.insert(more.end(), hole.records.begin(), hole.records.end());
  std::vector<DatedWeather> all;
  all.reserve(weather.size() + more.size());
  std::merge(weather.begin(), weather.end(), more.begin(), more.end(), std::back_inserter(all),
             [](const DatedWeather& a, const DatedWeather& b) { return a.begin < b.begin; });
  return all;
}

}  // namespace sunload
