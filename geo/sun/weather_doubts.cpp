// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/sun/weather_doubts.h"

#include <algorithm>
#include <cmath>

#include "geo/base/check.h"
#include "geo/base/units.h"

namespace sunload {

namespace {

void add_doubt(WeatherDoubt& doubt, const DatedWeather& record, double is, double at_most,
               double horizontal) {
  constexpr double rounding_w_m2 = 1e-6;
  if (is <= at_most + rounding_w_m2) return;
  if (doubt.records++ == 0) {
    doubt.line = record.line;
    doubt.is = is;
    doubt.at_most = at_most;
  }
  doubt.wh_m2 += (is - at_most) * horizontal * (record.end - record.begin) / seconds_per_hour;
}

void add_high_sun(WeatherDoubts& doubts, const DatedWeather& record, double sine) {
  const auto& [dni, dhi, ghi, albedo] = record.values;
  // Clouds may well leave nothing of the beam alone.
  const bool tells_of_sky = dhi || ghi;
  if (!tells_of_sky || sine <= std::sin(radians(surely_light_deg))) return;
  const double most = std::max({dni.value_or(0), dhi.value_or(0), ghi.value_or(0)});
  ++doubts.high_suns;
  doubts.most_w_m2 = std::max(doubts.most_w_m2, most);
  if (most > 0) return;
  if (doubts.no_light.records++ == 0) doubts.no_light.line = record.line;
}

}  // namespace

WeatherDoubts doubts_of(const std::vector<DatedWeather>& weather, const SunPath& path) {
  SUNLOAD_EXPECT(weather.size() == path.size(), "one interval per record");
  WeatherDoubts doubts;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const DatedWeather& record = weather[i];
    const auto& [dni, dhi, ghi, albedo] = record.values;
    const double sine = path[i].up_s > 0 ? sine_of_sun(path[i]) : 0;
    add_high_sun(doubts, record, sine);
    if (dni && path[i].up_s > 0)
      add_doubt(doubts.dni, record, *dni, extraterrestrial(path[i].sun.distance_au), sine);
    if (!ghi) continue;
    doubts.ghi_wh_m2 += *ghi * (record.end - record.begin) / seconds_per_hour;
    const WeatherSource source = source_of(record.values);
    if (source == WeatherSource::ghi_and_dhi) {
      add_doubt(doubts.beam_by_difference, record, *ghi - *dhi, strongest_beam(path[i]) * sine, 1);
      add_doubt(doubts.dhi_above_ghi, record, *dhi, *ghi, 1);
    } else if (source == WeatherSource::ghi_and_dni) {
      add_doubt(doubts.beam_above_ghi, record, *dni * sine, *ghi, 1);
    }
  }
  return doubts;
}

}  // namespace sunload
