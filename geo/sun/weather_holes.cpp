// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/sun/weather_holes.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "geo/base/units.h"

namespace sunload {

namespace {

bool is_within_a_day(UnixTime begin, UnixTime end, double offset_s) {
  return std::ceil((end + offset_s) / seconds_per_day) -
             std::floor((begin + offset_s) / seconds_per_day) <=
         1;
}

bool has_sun(const WeatherHole& hole, const SunEphemeris& sun) {
  const auto hours = static_cast<int>(std::ceil((hole.end - hole.begin) / seconds_per_hour));
  for (int hour = 0; hour < hours; ++hour)
    if (sun(hole.begin + hour * seconds_per_hour).elevation_deg > 0) return true;
  return false;
}

/// Of a record that begins or ends in the dark more sun than this is no sunrise or sunset [s].
constexpr double longest_edge_s = seconds_per_hour;

/// Those in whose middle the sun is up, or for more than an hour. Nothing where they are of the
/// dark, of a sunrise or a sunset: where no record, nor an hour of one, would have sun from its
/// beginning to its end.
std::vector<DatedWeather> sunlit_records(const WeatherHole& hole, int count,
                                         const SunEphemeris& sun) {
  const double length = (hole.end - hole.begin) / count;
  const auto is_up = [&](UnixTime at) { return sun(at).elevation_deg > 0; };
  std::vector<DatedWeather> records;
  bool is_day = false, ends_up = is_up(hole.begin);
  for (int k = 0; k < count; ++k) {
    const UnixTime begin = hole.begin + k * length, end = begin + length;
    const bool begins_up = std::exchange(ends_up, is_up(end)),
               is_middle_up = is_up((begin + end) / 2);
    // Up from its beginning to its end, or all of a day between two nights.
    const bool is_no_edge = is_middle_up && begins_up == ends_up;
    const bool is_long = length > longest_edge_s && ((begins_up && is_up(begin + longest_edge_s)) ||
                                                     (ends_up && is_up(end - longest_edge_s)));
    if (is_middle_up || is_long) records.push_back({begin, end, {}, hole.line});
    // What is up between two records shines on both.
    is_day = is_day || is_no_edge || is_long || (k > 0 && begins_up);
  }
  return is_day ? records : std::vector<DatedWeather>();
}

}  // namespace

std::vector<WeatherHole> sunlit_holes(const std::vector<DatedWeather>& weather,
                                      const SunEphemeris& sun, double longitude_deg) {
  constexpr double seconds_per_degree = seconds_per_day / 360;
  const double offset_s = longitude_deg * seconds_per_degree;
  std::vector<WeatherHole> holes;
  for (std::size_t i = 1; i < weather.size(); ++i) {
    const DatedWeather &before = weather[i - 1], &behind = weather[i];
    const double records_long = rows_left_out(before, behind);
    if (!(records_long >= 1)) continue;
    const auto whole_days = static_cast<int>((behind.begin - before.end + 1) / seconds_per_day);
    WeatherHole hole{before.end, behind.begin, behind.line, whole_days, {}};
    auto records = hole.whole_days == 0 ? sunlit_records(hole, static_cast<int>(records_long), sun)
                                        : hole.records;
    if (hole.whole_days == 0 ? records.empty() : !has_sun(hole, sun)) continue;
    // Hours of the dark may go on beyond midnight.
    if (!records.empty() && is_within_a_day(records.front().begin, records.back().end, offset_s))
      hole.records = std::move(records);
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
