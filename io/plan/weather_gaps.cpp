// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/weather_gaps.h"

namespace sunload {

std::vector<PeriodStep> steps_of(const std::vector<DatedWeather>& weather) {
  std::vector<PeriodStep> steps;
  steps.reserve(weather.size());
  for (const auto& w : weather)
    steps.push_back({w.begin, w.end, (w.begin + w.end) / 2, SunInstant::middle_of_sunlit_part});
  return steps;
}

std::map<WeatherSource, std::size_t> WeatherGaps::complete(
    std::vector<DatedWeather>& weather) const {
  Records places;
  for (std::size_t i = 0; i < weather.size(); ++i)
    if (is_incomplete(weather[i].values, source_) &&
        source_of(weather[i].values) != WeatherSource::none)
      places.push_back(i);
  const SunPath path = path_of(weather, places);
  std::map<WeatherSource, std::size_t> records;
  for (std::size_t k = 0; k < places.size(); ++k) {
    WeatherValues& values = weather[places[k]].values;
    ++records[source_of(values)];
    values = completed(values, path[k], study_.light.decomposition, site_.elevation_m);
  }
  return records;
}

std::size_t WeatherGaps::complete_dark(std::vector<DatedWeather>& weather) const {
  const Records records = dark(weather);
  for (const std::size_t i : records) put_zeros(weather[i].values);
  return records.size();
}

std::vector<DatedWeather> WeatherGaps::filled(const std::vector<DatedWeather>& weather) const {
  auto filled = fill_missing(weather, source_, study_.light.missing).weather;
  for (const std::size_t i : dark(weather)) {
    filled[i].values = weather[i].values;
    put_zeros(filled[i].values);
  }
  return filled;
}

void WeatherGaps::put_zeros(WeatherValues& values) const {
  for (const WeatherQuantity quantity : needed(source_))
    values.*quantity = (values.*quantity).value_or(0);
}

SunPath WeatherGaps::path_of(const std::vector<DatedWeather>& weather,
                             const Records& records) const {
  if (records.empty()) return {};
  std::vector<DatedWeather> these;
  these.reserve(records.size());
  for (const std::size_t i : records) these.push_back(weather[i]);
  return sun_path(steps_of(these), site_, study_.sun.refraction, study_.sun.ut1_utc);
}

WeatherGaps::Records WeatherGaps::dark(const std::vector<DatedWeather>& weather) const {
  Records lacking, in_the_dark;
  for (std::size_t i = 0; i < weather.size(); ++i)
    if (is_incomplete(weather[i].values, source_)) lacking.push_back(i);
  const SunPath path = path_of(weather, lacking);
  for (std::size_t k = 0; k < lacking.size(); ++k)
    if (path[k].up_s <= 0) in_the_dark.push_back(lacking[k]);
  return in_the_dark;
}

}  // namespace sunload
