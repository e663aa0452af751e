// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/result/mesh_error.h"

#include <algorithm>
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

/// 1 for patches of `base` that `variant` does not have just so, else 0.
std::vector<double> unlike_patches(const ResultReader& base, const ResultReader& variant) {
  const auto of_variant = places(variant), of_base = places(base);
  const std::set<std::array<double, 4>> known(of_variant.begin(), of_variant.end());
  std::vector<double> unlike;
  unlike.reserve(of_base.size());
  for (const auto& place : of_base) unlike.push_back(known.contains(place) ? 0 : 1);
  return unlike;
}

/// Of the light that the scene sends, what some patches send.
double share_sent(const ResultReader& result, const std::vector<double>& by_patches) {
  auto power = result.doubles("patch_area");
  if (result.has("power_load")) {
    const auto per_area = result.doubles("power_load");
    for (std::size_t i = 0; i < power.size(); ++i) power[i] *= per_area[i];
  }
  double some = 0, all = 0;
  for (std::size_t i = 0; i < power.size(); ++i) {
    some += by_patches[i] * power[i];
    all += power[i];
  }
  return all > 0 ? some / all : 0;
}

}  // namespace

std::vector<double> unlike_reflections(const ResultReader& base, const ResultReader& variant) {
  auto unlike = unlike_patches(base, variant);
  const double of_the_scene = share_sent(base, unlike);
  for (double& share : unlike) share = std::max(share, of_the_scene);
  return unlike;
}

}  // namespace sunload
