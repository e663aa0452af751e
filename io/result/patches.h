// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Patches of a result as triangles, and values at their corners.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/result/shown_quantity.h"

namespace sunload {

/// Patches as triangles: both sides of a two-sided surface are patches of their own,
/// with opposite windings.
struct ResultPatches {
  explicit ResultPatches(const ResultReader& result);

  std::vector<Vec3> vertices;  ///< relative to `origin`, z up
  std::vector<std::array<std::int32_t, 3>> corners;
  std::vector<Vec3> normal;
  std::vector<double> area;
  std::vector<std::int32_t> object;
  std::vector<std::string> object_names;
  Vec3 origin;
};

/// Angle between patches up to which a surface looks smooth, where nobody says.
inline constexpr double default_crease_deg = 20;

/// Values of the corners: area-weighted means over the patches around a corner whose normals differ
/// by no more than `crease_angle_deg`. Vertices in the same place are one. Values that are not
/// known are left out of the means; a corner without known ones is NaN.
std::vector<std::array<double, 3>> corner_values(const ResultPatches& patches,
                                                 const std::vector<double>& values,
                                                 double crease_angle_deg);

}  // namespace sunload
