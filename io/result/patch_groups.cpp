// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/result/patch_groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "geo/mesh/mesh.h"
#include "io/result/named_parts.h"

namespace sunload {
namespace {

std::vector<double> components(const ResultReader& result, const char* dataset,
                               std::size_t component) {
  const auto flat = result.doubles(dataset);
  std::vector<double> values(flat.size() / 3);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = flat[3 * i + component];
  return values;
}

/// Whether each patch is of a wall or of a window.
std::vector<char> is_upright(const ResultReader& result) {
  std::vector<char> upright;
  for (const auto kind : result.integers("patch_surface")) {
    const auto surface = static_cast<Surface>(kind);
    upright.push_back(surface == Surface::wall || surface == Surface::window ? 1 : 0);
  }
  return upright;
}

/// By the height of a patch's middle above the lowest corner of its object.
PatchDivision storeys(const ResultReader& result, double storey_m) {
  constexpr std::int32_t highest = 1000;
  const auto object = result.integers("patch_object"), corners = result.integers("patch_vertices");
  const auto height = components(result, "patch_centroid", 2),
             z = components(result, "vertex_position", 2);
  std::map<std::int32_t, double> foot;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const double low = z[static_cast<std::size_t>(corners[k])];
    const auto [found, is_new] = foot.try_emplace(object[k / 3], low);
    found->second = std::min(found->second, low);
  }
  PatchDivision division{"storey", {}, {}};
  const auto upright = is_upright(result);
  std::int32_t top = -1;
  for (std::size_t i = 0; i < height.size(); ++i) {
    const double above = std::max(0.0, height[i] - foot.at(object[i]));
    const auto storey = upright[i] != 0
                            ? static_cast<std::int32_t>(std::min<double>(highest, above / storey_m))
                            : -1;
    division.of_patch.push_back(storey);
    top = std::max(top, storey);
  }
  for (std::int32_t k = 0; k <= top; ++k)
    division.names.push_back(fmt::format("{:g}-{:g} m", k * storey_m, (k + 1) * storey_m));
  return division;
}

}  // namespace

PatchDivision orientations(const ResultReader& result) {
  PatchDivision division{
      "orientation",
      {"north", "north-east", "east", "south-east", "south", "south-west", "west", "north-west"},
      {}};
  const auto x = components(result, "patch_normal", 0), y = components(result, "patch_normal", 1);
  const double north = result.number_attribute("north_deg");
  const double turn_deg = std::isnan(north) ? 0 : north;
  const auto upright = is_upright(result);
  const double sector_deg = 360.0 / static_cast<double>(division.names.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double azimuth = horizontal({x[i], y[i], 0}).azimuth_deg + turn_deg;
    const auto sector =
        static_cast<std::int32_t>(wrapped_deg(azimuth + sector_deg / 2) / sector_deg);
    division.of_patch.push_back(upright[i] != 0 ? sector : -1);
  }
  return division;
}

std::vector<PatchDivision> patch_divisions(const ResultReader& result, const MoreGroups& more) {
  const std::size_t patches = result.shape("patch_area").front();
  std::vector<PatchDivision> all{
      {"whole", {"whole"}, std::vector<std::int32_t>(patches, 0)},
      {"surface", {surface_names.begin(), surface_names.end()}, result.integers("patch_surface")},
      {"object", result.strings("object_name"), result.integers("patch_object")},
      {"facade", result.strings("facade_name"), result.integers("patch_facade")}};
  const auto selections = selection_names(result);
  for (std::size_t k = 0; k < selections.size(); ++k)
    all.push_back({"selection", {selections[k]}, selection_entries(result, k)});
  if (more.orientations) all.push_back(orientations(result));
  if (more.storey_m) all.push_back(storeys(result, *more.storey_m));
  return all;
}

PatchMembers members_of(const PatchDivision& division, const std::vector<double>& area) {
  SUNLOAD_EXPECT(division.of_patch.size() == area.size(), division.kind);
  PatchMembers all{division.kind, division.names, {}};
  for (std::size_t i = 0; i < area.size(); ++i)
    if (division.of_patch[i] >= 0 && area[i] > 0)
      all.members.push_back({i, static_cast<std::size_t>(division.of_patch[i]), area[i]});
  return all;
}

namespace {

std::vector<PatchMembers> all_members(const ResultReader& result) {
  const auto area = result.doubles("patch_area");
  if (area.empty()) throw InputError({result.path()}, "the result has no patches");
  std::vector<PatchMembers> all;
  for (const PatchDivision& division : patch_divisions(result))
    all.push_back(members_of(division, area));
  return all;
}

}  // namespace

PatchGroups::PatchGroups(const ResultReader& result)
    : PatchGroups(result.shape("patch_area").front(), all_members(result)) {}

PatchGroups::PatchGroups(std::size_t patches, const std::vector<PatchMembers>& kinds)
    : patches_(patches) {
  for (const PatchMembers& of : kinds) {
    std::vector<char> is_used(of.names.size(), 0);
    for (const PatchMember& member : of.members) is_used.at(member.name) = 1;
    std::vector<std::size_t> group_of_name(of.names.size(), 0);
    for (std::size_t name = 0; name < of.names.size(); ++name) {
      if (is_used[name] == 0) continue;
      group_of_name[name] = groups_.size();
      groups_.push_back({of.kind, of.names[name], 0});
    }
    for (const auto& [patch, name, area] : of.members) {
      const std::size_t group = group_of_name[name];
      groups_[group].area_m2 += area;
      members_.push_back({patch, group, area});
    }
  }
}

std::vector<double> PatchGroups::means(const double* patch_values) const {
  std::vector<double> sums(groups_.size(), 0);
  for (const auto& [patch, group, area] : members_) sums[group] += area * patch_values[patch];
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
                                                    const PatchGroups& groups,
                                                    const std::string& dataset) {
  std::vector<std::vector<double>> by_group(groups.groups().size());
  if (dataset.empty() || !result.has(dataset)) return by_group;
  const auto realizations = result.shape(dataset).front();
  for (std::size_t r = 0; r < realizations; ++r) {
    const auto means = groups.means(result.row(dataset, r).data());
    for (std::size_t g = 0; g < means.size(); ++g) by_group[g].push_back(means[g]);
  }
  return by_group;
}

}  // namespace sunload
