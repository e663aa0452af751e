// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/explain/place.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "geo/base/check.h"
#include "io/result/common_area.h"

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

namespace {

/// 1 for what is of the place.
std::vector<char> marked(const Place& place, std::size_t count) {
  std::vector<char> is_of_it(count, 0);
  for (const auto i : place.receivers) is_of_it[i] = 1;
  return is_of_it;
}

/// As compare counts it; empty where both places are the same area.
std::string different_area(const ResultReader& base, const Place& of_base,
                           const ResultReader& variant, const Place& of_variant) {
  const auto base_area = base.doubles("patch_area"), variant_area = variant.doubles("patch_area");
  const CommonArea common = common_area(
      base, variant, {marked(of_base, base_area.size()), marked(of_variant, variant_area.size())});
  const auto is_whole = [](const Place& place, const std::vector<double>& in_common,
                           const std::vector<double>& area) {
    return std::all_of(place.receivers.begin(), place.receivers.end(),
                       [&](std::size_t i) { return in_common[i] >= area[i]; });
  };
  if (is_whole(of_base, common.base, base_area) &&
      is_whole(of_variant, common.variant, variant_area))
    return {};
  return fmt::format(
      "the place differs: {} in {} and {} in {}, of which {:.6g} m² are the same surfaces; here "
      "each "
      "mean is over all of its own, while compare takes what both have",
      extent_of(base, of_base), base.text_attribute("variant"), extent_of(variant, of_variant),
      variant.text_attribute("variant"),
      std::accumulate(common.base.begin(), common.base.end(), 0.0));
}

/// Where the place's sensors stand and what they face.
std::vector<Vec3> stands(const ResultReader& result, const Place& place) {
  const auto position = result.doubles("sensor_position"), normal = result.doubles("sensor_normal");
  std::vector<Vec3> all;
  for (const auto s : place.receivers) {
    all.push_back(result.origin() +
                  Vec3{position[3 * s], position[3 * s + 1], position[3 * s + 2]});
    all.emplace_back(Vec3{normal[3 * s], normal[3 * s + 1], normal[3 * s + 2]});
  }
  return all;
}

bool stand_alike(const std::vector<Vec3>& base, const std::vector<Vec3>& variant) {
  constexpr double rounding = 1e-6;  // of coordinates of a country, in m
  return std::equal(base.begin(), base.end(), variant.begin(), variant.end(),
                    [](Vec3 a, Vec3 b) { return norm(a - b) <= rounding; });
}

}  // namespace

std::vector<std::string> notes_on_places(const ResultReader& base, const ResultReader& variant,
                                         const NamedParts& parts) {
  const Place of_base = place_named(base, parts), of_variant = place_named(variant, parts);
  std::vector<std::string> notes;
  if (!of_base.is_of_sensors) {
    if (auto area = different_area(base, of_base, variant, of_variant); !area.empty())
      notes.push_back(std::move(area));
  } else if (!stand_alike(stands(base, of_base), stands(variant, of_variant))) {
    notes.emplace_back("the place differs: its sensors stand elsewhere, or face another way");
  }
  if (auto turned = different_north_in_words(base, variant); !turned.empty())
    notes.push_back(std::move(turned));
  return notes;
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
