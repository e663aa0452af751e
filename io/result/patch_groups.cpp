// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/result/patch_groups.h"

#include <algorithm>
#include <array>

#include "geo/base/check.h"
#include "geo/mesh/mesh.h"

namespace sunload {
namespace {

/// Names of one kind of group and the entry of each patch (-1: none).
struct Division {
  const char* kind;
  std::vector<std::string> names;
  std::vector<std::int32_t> of_patch;
};

std::array<Division, 4> divisions(const ResultReader& result, std::size_t patches) {
  return {
      {{"whole", {"whole"}, std::vector<std::int32_t>(patches, 0)},
       {"surface", {surface_names.begin(), surface_names.end()}, result.integers("patch_surface")},
       {"object", result.strings("object_name"), result.integers("patch_object")},
       {"facade", result.strings("facade_name"), result.integers("patch_facade")}}};
}

}  // namespace

PatchGroups::PatchGroups(const ResultReader& result)
    : PatchGroups(result, result.doubles("patch_area")) {}

PatchGroups::PatchGroups(const ResultReader& result, std::vector<double> area)
    : area_(std::move(area)) {
  if (area_.empty()) throw InputError({result.path()}, "the result has no patches");
  group_of_.assign(area_.size() * kinds, -1);
  const auto all = divisions(result, area_.size());
  for (std::size_t kind = 0; kind < kinds; ++kind) {
    const auto& division = all[kind];
    SUNLOAD_EXPECT(division.of_patch.size() == area_.size(), division.kind);
    std::vector<std::int32_t> group_of_entry(division.names.size(), -1);
    std::vector<char> used(division.names.size(), 0);
    for (std::size_t i = 0; i < area_.size(); ++i)
      if (const auto entry = division.of_patch[i]; entry >= 0 && area_[i] > 0)
        used.at(static_cast<std::size_t>(entry)) = 1;
    for (std::size_t entry = 0; entry < used.size(); ++entry) {
      if (!used[entry]) continue;
      group_of_entry[entry] = static_cast<std::int32_t>(groups_.size());
      groups_.push_back({division.kind, division.names[entry], 0});
    }
    for (std::size_t i = 0; i < area_.size(); ++i) {
      if (division.of_patch[i] < 0 || area_[i] <= 0) continue;
      const auto group = group_of_entry[static_cast<std::size_t>(division.of_patch[i])];
      group_of_[i * kinds + kind] = group;
      groups_[static_cast<std::size_t>(group)].area_m2 += area_[i];
    }
  }
}

std::vector<double> PatchGroups::means(const double* patch_values) const {
  std::vector<double> sums(groups_.size(), 0);
  for (std::size_t i = 0; i < area_.size(); ++i)
    for (std::size_t kind = 0; kind < kinds; ++kind)
      if (const auto group = group_of_[i * kinds + kind]; group >= 0)
        sums[static_cast<std::size_t>(group)] += area_[i] * patch_values[i];
  for (std::size_t g = 0; g < sums.size(); ++g) sums[g] /= groups_[g].area_m2;
  return sums;
}

std::vector<double> group_means(const ResultReader& result, const PatchGroups& groups,
                                const std::string& dataset) {
  const auto values = result.doubles(dataset);
  SUNLOAD_EXPECT(values.size() == groups.patch_count(), dataset);
  return groups.means(values.data());
}

std::vector<std::vector<double>> group_realizations(const ResultReader& result,
                                                    const PatchGroups& groups) {
  std::vector<std::vector<double>> by_group(groups.groups().size());
  if (!result.has("light_load_realization")) return by_group;
  const auto realizations = result.shape("light_load_realization").front();
  for (std::size_t r = 0; r < realizations; ++r) {
    const auto means = groups.means(result.row("light_load_realization", r).data());
    for (std::size_t g = 0; g < means.size(); ++g) by_group[g].push_back(means[g]);
  }
  return by_group;
}

}  // namespace sunload
