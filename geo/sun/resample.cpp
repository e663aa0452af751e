// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/sun/resample.h"

#include <algorithm>

namespace sunload {

namespace {

double overlap(double a_begin, double a_end, double b_begin, double b_end) {
  return std::max(0.0, std::min(a_end, b_end) - std::max(a_begin, b_begin));
}

bool has_night_inside(const SunInterval& when) {
  return when.up_s < when.up_end - when.up_begin - same_time_s;
}

bool holds(const SunInterval& outer, const SunInterval& inner) {
  return outer.begin <= inner.begin + same_time_s && inner.end <= outer.end + same_time_s;
}

/// Time that both have in common while the sun is up. Of two sunlit parts with a night between them
/// only the ends are known, and how long they are together.
double common_sunlit_s(const SunInterval& a, const SunInterval& b) {
  const double hulls = overlap(a.up_begin, a.up_end, b.up_begin, b.up_end);
  if (!has_night_inside(a) && !has_night_inside(b)) return hulls;
  if (holds(a, b)) return b.up_s;
  if (holds(b, a)) return a.up_s;
  return std::min({hulls, a.up_s, b.up_s});
}

/// Calls `take(w, time)` for each record that has time in common with an interval.
template <class Take>
void for_overlaps(const std::vector<SunnyWeather>& weather, const SunInterval& to, Take&& take) {
  auto from = std::upper_bound(weather.begin(), weather.end(), to.begin,
                               [](double t, const SunnyWeather& w) { return t < w.when.end; });
  for (; from != weather.end() && from->when.begin < to.end; ++from)
    take(static_cast<std::size_t>(from - weather.begin()),
         overlap(from->when.begin, from->when.end, to.begin, to.end));
}

/// The mean sine of elevation over the sunlit parts of the intervals that lie inside of each
/// record; 0 without such.
std::vector<double> mean_sines(const std::vector<SunnyWeather>& weather, const SunPath& path) {
  std::vector<double> sum(weather.size(), 0), time(weather.size(), 0);
  for (const SunInterval& to : path)
    for_overlaps(weather, to, [&](std::size_t w, double) {
      if (!holds(weather[w].when, to)) return;
      const double common = common_sunlit_s(weather[w].when, to);
      sum[w] += common * sine_of_sun(to);
      time[w] += common;
    });
  for (std::size_t w = 0; w < sum.size(); ++w) sum[w] = time[w] > 0 ? sum[w] / time[w] : 0;
  return sum;
}

}  // namespace

Resampled resample(const std::vector<SunnyWeather>& weather, const SunPath& path) {
  Resampled out;
  out.mean.reserve(path.size());
  const auto mean_sine = mean_sines(weather, path);
  for (std::size_t i = 0; i < path.size(); ++i) {
    const SunInterval& to = path[i];
    Irradiance sum;
    double covered = 0;
    for_overlaps(weather, to, [&](std::size_t number, double time) {
      const auto& [w, mean] = weather[number];
      covered += time;
      // Of the record's beam as much as of its sunlit part lies in this one's; on the ground it
      // follows the sun.
      const double lit = has_night_inside(w) ? w.up_s : w.up_end - w.up_begin;
      const double beam_time = lit > 0 ? w.length_s() / lit * common_sunlit_s(w, to) : 0;
      const double height =
          holds(w, to) && mean_sine[number] > 0 ? sine_of_sun(to) / mean_sine[number] : 1;
      sum.dni += mean.dni * beam_time;
      sum.dhi += mean.dhi * time;
      sum.ghi += mean.dhi * time + (mean.ghi - mean.dhi) * (lit > 0 ? beam_time * height : time);
    });
    if (covered < to.length_s() - 1) out.uncovered.push_back(i);
    const double length = to.length_s();
    out.mean.push_back({sum.dni / length, sum.dhi / length, std::max(0.0, sum.ghi / length)});
  }
  return out;
}

}  // namespace sunload
