// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The level at which light is exchanged, by lines and by samples.
#pragma once

#include "solver/mesh/hierarchy.h"

namespace sunload {

/// The largest element about a patch that is still small as seen from where the light comes from,
/// `path_m` before it met the patch at `point`: of a form factor of at most `largest_link`. 0: the
/// patch itself. The element's centre lies as far away as the light has come, give or take its
/// distance from `point`.
std::uint32_t linked_element(const Hierarchy& hierarchy, std::size_t patch, Vec3 point,
                             double path_m, double largest_link);

/// Where rays have met patches, those of some packets side by side.
struct LinkedPoints {
  static constexpr std::size_t most = packets_together * packet_size;
  std::int32_t patch[most];  ///< -1: none
  alignas(64) double x[most], y[most], z[most];
  alignas(64) double path_m[most], largest_link[most];
};
/// The same of each of them; where no patch was met it means nothing.
void linked_elements(const Hierarchy& hierarchy, const LinkedPoints& points,
                     std::uint32_t (&element)[LinkedPoints::most]);

}  // namespace sunload
