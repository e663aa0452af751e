// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/explain/light_of_part.h"

#include "geo/base/units.h"
#include "io/result/own_seasons.h"
#include "io/result/time.h"

namespace sunload {

std::vector<std::unique_ptr<const ResultReader>> readers_of_bands(const ResultReader& result) {
  std::vector<std::unique_ptr<const ResultReader>> readers;
  const bool is_rgb = result.bands() == Bands::rgb;
  for (std::size_t b = 0; b < (is_rgb ? band_count : 1); ++b) {
    auto reader =
        std::make_unique<ResultReader>(result.path(), is_rgb ? std::optional(b) : std::nullopt);
    if (result.chosen().any()) reader->choose(result.chosen());
    readers.push_back(std::move(reader));
  }
  return readers;
}

std::vector<std::vector<float>> reflectances_of_bands(const ResultScene& scene) {
  std::vector<std::vector<float>> of_bands;
  for (const PatchOptics& optics : scene.traced().optics_of_band)
    of_bands.push_back(optics.diffuse);
  return of_bands;
}

std::vector<double> chosen_part(const ResultReader& result, const LightSeries& light) {
  if (!result.chosen().any()) return {};
  return chosen_shares(result.chosen(), light.spans(), result_zone(result),
                       result.number_attribute("latitude_deg"), own_seasons(result));
}

namespace {

/// Time of the chosen part [s].
double seconds_of(const LightSeries& light, const std::vector<double>& shares) {
  double seconds = 0;
  for (std::size_t i = 0; i < light.intervals.size(); ++i)
    seconds += shares[i] * light.intervals[i].when.length_s();
  return seconds;
}

SentLight sent_in_part(const ResultReader& result, const ResultScene& scene) {
  const PatchOptics& optics = scene.traced().optics;
  SentLight sent(optics.diffuse.size(), 0);
  const auto readers = readers_of_bands(result);
  const auto reflectances = reflectances_of_bands(scene);
  for (std::size_t b = 0; b < readers.size(); ++b) {
    const auto load = readers[b]->doubles("light_load");
    for (std::size_t i = 0; i < sent.size(); ++i)
      sent[i] += joules_per_kwh * static_cast<double>(reflectances[b][i]) * load[i] /
                 static_cast<double>(readers.size());
  }
  if (!optics.any_emission) return sent;
  const double seconds = seconds_of(scene.light(), chosen_part(result, scene.light()));
  for (std::size_t i = 0; i < sent.size(); ++i)
    sent[i] += seconds * static_cast<double>(optics.emission[i]);
  return sent;
}

}  // namespace

SentLight sent_light(const ResultReader& result, const ResultScene& scene) {
  if (result.chosen().any()) return sent_in_part(result, scene);
  SentLight sent = result.doubles("power_load");
  for (double& value : sent) value *= joules_per_kwh;
  return sent;
}

}  // namespace sunload
