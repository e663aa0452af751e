// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/result/mesh_error.h"

#include <array>
#include <set>

namespace sunload {

namespace {

/// Where a patch lies, and how large it is, to the last bit: equal meshes are made alike. Origins
/// of scenes may differ.
std::vector<std::array<double, 4>> places(const ResultReader& result) {
  const auto centroid = result.doubles("patch_centroid"), area = result.doubles("patch_area");
  const Vec3 origin = result.origin();
  std::vector<std::array<double, 4>> all;
  for (std::size_t i = 0; i < area.size(); ++i)
    all.push_back({origin.x + centroid[3 * i], origin.y + centroid[3 * i + 1],
                   origin.z + centroid[3 * i + 2], area[i]});
  return all;
}

}  // namespace

std::vector<double> unlike_patches(const ResultReader& base, const ResultReader& variant) {
  const auto of_variant = places(variant), of_base = places(base);
  const std::set<std::array<double, 4>> known(of_variant.begin(), of_variant.end());
  std::vector<double> unlike;
  unlike.reserve(of_base.size());
  for (const auto& place : of_base) unlike.push_back(known.contains(place) ? 0 : 1);
  return unlike;
}

}  // namespace sunload
