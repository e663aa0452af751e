// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What the mesh itself puts a light load off, beside the error of lines and samples.
///
/// Direct light and the sky's are means over each patch, whatever its size; reflected light is made
/// of one radiosity per patch. On the default mesh, and where patches have edges of some metres,
/// that puts nine facades in ten and more off by less than this share of their reflected light
/// (measured against fine meshes: docs/validation.md).
#pragma once

#include <vector>

#include "io/result/reader.h"

namespace sunload {

inline constexpr double mesh_error_of_reflected = 0.1;

/// Per group the share above of its mean `reflected` load [kWh m-2, or klx h].
inline std::vector<double> mesh_errors(std::vector<double> reflected) {
  for (double& load : reflected) load *= mesh_error_of_reflected;
  return reflected;
}

/// Share of what each patch of `base` receives by reflection that unlike meshes put off: all of it
/// where `variant` does not have the patch just so, elsewhere as much as such patches send of the
/// light that the scene sends. Where both have the same patches the mesh puts them off alike, and
/// says nothing of their difference: 0.
std::vector<double> unlike_reflections(const ResultReader& base, const ResultReader& variant);

}  // namespace sunload
