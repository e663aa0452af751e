// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/explain/place.h"

#include <fmt/format.h>

#include <numeric>

#include "geo/base/check.h"

namespace sunload {

Place place_named(const ResultReader& result, const NamedParts& parts) {
  Place place;
  place.is_of_sensors = !parts.sensors.empty();
  if (place.is_of_sensors == parts.choose_patches())
    throw InputError({result.path()},
                     parts.empty() ? "no place is named" : "facades or objects and sensors",
                     "light is explained for one place",
                     "write --facade NAME or --object NAME, or --sensor NUMBER; info lists them");
  place.receivers =
      place.is_of_sensors ? chosen_sensors(result, parts) : chosen_patches(result, parts);
  if (place.receivers.empty())
    throw InputError({result.path()}, "the place that is named has no patches",
                     "floors and what is covered receive no light", "name another one");
  const auto area = result.doubles("patch_area");
  for (const auto i : place.receivers) place.weight.push_back(place.is_of_sensors ? 1 : area[i]);
  const double sum = std::accumulate(place.weight.begin(), place.weight.end(), 0.0);
  for (double& weight : place.weight) weight /= sum;
  return place;
}

std::string words_of(const NamedParts& parts) {
  std::string words;
  const auto append = [&](const auto& names, const char* before) {
    for (const auto& name : names) words += (words.empty() ? "" : ", ") + (before + name);
  };
  append(parts.facades, "");
  append(parts.objects, "");
  append(parts.selections, "");
  append(parts.sensors, "sensor ");
  return words;
}

/// Mean over the place of one row of values per receiver.
double mean_over(const Place& place, const std::vector<double>& values) {
  double mean = 0;
  for (std::size_t k = 0; k < place.receivers.size(); ++k)
    mean += place.weight[k] * values[place.receivers[k]];
  return mean;
}

std::string extent_of(const ResultReader& result, const Place& place) {
  if (place.is_of_sensors)
    return fmt::format("{} sensor{}", place.receivers.size(),
                       place.receivers.size() > 1 ? "s" : "");
  const auto area = result.doubles("patch_area");
  double sum = 0;
  for (const auto i : place.receivers) sum += area[i];
  return fmt::format("{:.6g} m²", sum);
}

}  // namespace sunload
