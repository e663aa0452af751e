// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/sun/resample.h"

#include <algorithm>

namespace sunload {

namespace {

double overlap(double a_begin, double a_end, double b_begin, double b_end) {
  return std::max(0.0, std::min(a_end, b_end) - std::max(a_begin, b_begin));
}

/// With sun: bounds of one part of an interval or several, and how long they are together.
struct Sunny {
  UnixTime begin, end;
  double length_s;
  bool has_gap_inside() const { return length_s < end - begin - same_time_s; }
};
Sunny up_of(const SunInterval& when) { return {when.up_begin, when.up_end, when.up_s}; }
Sunny sunlit_of(const SunInterval& when) {
  return {when.sunlit_begin, when.sunlit_end, when.sunlit_s};
}

using PartWithSun = Sunny (*)(const SunInterval&);

bool holds(const SunInterval& outer, const SunInterval& inner) {
  return outer.begin <= inner.begin + same_time_s && inner.end <= outer.end + same_time_s;
}

/// Time that both have in common with sun. Of parts with night or hills between them only the ends
/// are known, and how long they are together.
double common_s(const SunInterval& a, const SunInterval& b, PartWithSun part) {
  const Sunny in_a = part(a), in_b = part(b);
  const double hulls = overlap(in_a.begin, in_a.end, in_b.begin, in_b.end);
  if (!in_a.has_gap_inside() && !in_b.has_gap_inside()) return hulls;
  if (holds(a, b)) return in_b.length_s;
  if (holds(b, a)) return in_a.length_s;
  return std::min({hulls, in_a.length_s, in_b.length_s});
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
      const double common = common_s(weather[w].when, to, up_of);
      sum[w] += common * sine_of_sun(to);
      time[w] += common;
    });
  for (std::size_t w = 0; w < sum.size(); ++w) sum[w] = time[w] > 0 ? sum[w] / time[w] : 0;
  return sum;
}

/// Means of an interval from what records bring into it.
struct Brought {
  Irradiance sum;
  void add(const Irradiance& mean, double time, double dni_time, double beam_time) {
    sum.dni += mean.dni * dni_time;
    sum.dhi += mean.dhi * time;
    sum.ghi += mean.dhi * time + (mean.ghi - mean.dhi) * beam_time;
  }
  Irradiance mean(double length) const {
    return {sum.dni / length, sum.dhi / length, std::max(0.0, sum.ghi / length)};
  }
};

}  // namespace

Resampled resample(const std::vector<SunnyWeather>& weather, const SunPath& path) {
  Resampled out;
  out.mean.reserve(path.size());
  out.past_hills.reserve(path.size());
  const auto mean_sine = mean_sines(weather, path);
  for (std::size_t i = 0; i < path.size(); ++i) {
    const SunInterval& to = path[i];
    Brought open, past_hills;
    double covered = 0;
    for_overlaps(weather, to, [&](std::size_t number, double time) {
      const SunInterval& w = weather[number].when;
      const Irradiance& mean = weather[number].mean;
      covered += time;
      // Of the record's beam as much as of its sunlit part lies in this one's; on the ground it
      // follows the sun.
      const Sunny up = up_of(w);
      const double lit = up.has_gap_inside() ? up.length_s : up.end - up.begin;
      const double denser = lit > 0 ? w.length_s() / lit : 0;
      const double height =
          holds(w, to) && mean_sine[number] > 0 ? sine_of_sun(to) / mean_sine[number] : 1;
      const auto bring = [&](Brought& brought, PartWithSun part) {
        const double dni_time = denser * common_s(w, to, part);
        brought.add(mean, time, dni_time, lit > 0 ? dni_time * height : time);
      };
      bring(open, up_of);
      bring(past_hills, sunlit_of);
    });
    if (covered < to.length_s() - 1) out.uncovered.push_back(i);
    out.mean.push_back(open.mean(to.length_s()));
    out.past_hills.push_back(past_hills.mean(to.length_s()));
  }
  return out;
}

}  // namespace sunload
