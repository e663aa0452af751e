// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/result/named_parts.h"

#include <cmath>

#include "io/base/name_pattern.h"

namespace sunload {
namespace {

/// Marks the patches whose entry is among those chosen.
void mark(const std::vector<std::int32_t>& entry, const std::vector<std::size_t>& chosen,
          std::size_t entries, std::vector<char>& is_chosen) {
  std::vector<char> is_wanted(entries, 0);
  for (const auto k : chosen) is_wanted[k] = 1;
  for (std::size_t p = 0; p < entry.size(); ++p)
    if (entry[p] >= 0 && is_wanted[static_cast<std::size_t>(entry[p])]) is_chosen[p] = 1;
}

}  // namespace

std::vector<std::string> sensor_names(const ResultReader& result) {
  std::vector<std::string> names;
  if (!result.has("sensor_position")) return names;
  for (std::size_t s = 0; s < result.shape("sensor_position").front(); ++s)
    names.push_back(std::to_string(s));
  return names;
}

std::vector<std::string> selection_names(const ResultReader& result) {
  return result.has("patch_selected") && result.has("selection_name")
             ? result.strings("selection_name")
             : std::vector<std::string>();
}

std::vector<std::int32_t> selection_entries(const ResultReader& result, std::size_t selection) {
  std::vector<std::int32_t> entries;
  for (const double flag : result.row("patch_selected", selection))
    entries.push_back(flag != 0 ? 0 : -1);
  return entries;
}

std::vector<std::size_t> chosen_facades(const ResultReader& result, const NamedParts& parts) {
  return matching_names(parts.facades, result.strings("facade_name"), "facade", result.path());
}

std::vector<std::size_t> chosen_objects(const ResultReader& result, const NamedParts& parts) {
  return matching_names(parts.objects, result.strings("object_name"), "object", result.path());
}

std::vector<std::size_t> chosen_selections(const ResultReader& result, const NamedParts& parts) {
  return matching_names(parts.selections, selection_names(result), "selection", result.path());
}

std::vector<std::size_t> chosen_sensors(const ResultReader& result, const NamedParts& parts) {
  return matching_names(parts.sensors, sensor_names(result), "sensor", result.path());
}

std::vector<std::size_t> chosen_patches(const ResultReader& result, const NamedParts& parts) {
  std::vector<char> is_chosen(result.shape("patch_area").front(), parts.choose_patches() ? 0 : 1);
  if (!parts.facades.empty())
    mark(result.integers("patch_facade"), chosen_facades(result, parts),
         result.strings("facade_name").size(), is_chosen);
  if (!parts.objects.empty())
    mark(result.integers("patch_object"), chosen_objects(result, parts),
         result.strings("object_name").size(), is_chosen);
  if (!parts.selections.empty())
    for (const auto k : chosen_selections(result, parts))
      mark(selection_entries(result, k), {0}, 1, is_chosen);
  std::vector<std::size_t> patches;
  for (std::size_t p = 0; p < is_chosen.size(); ++p)
    if (is_chosen[p]) patches.push_back(p);
  return patches;
}

std::string different_north_in_words(const ResultReader& base, const ResultReader& variant) {
  // A map's grid turns by this over a kilometre, and ranges of azimuth overlook it.
  constexpr double worth_telling_deg = 0.01;
  const double turn = std::remainder(
      base.number_attribute("north_deg") - variant.number_attribute("north_deg"), 360);
  if (!(std::abs(turn) > worth_telling_deg)) return {};
  return "the scenes are turned against each other: facades and orientations are named by their "
         "azimuth, and a wall of two names is in rows of one result alone; objects are the same";
}

}  // namespace sunload
