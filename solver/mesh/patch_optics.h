// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What the materials of the patches do with light, side by side.
#pragma once

#include <cstddef>
#include <vector>

#include "solver/mesh/hierarchy.h"

namespace sunload {

/// Shares and exitance of every patch.
struct PatchOptics {
  std::vector<float> diffuse, emission;
  std::vector<float> mirror;   ///< of light from the normal
  std::vector<float> glossy;   ///< the same
  std::vector<float> passed;   ///< straight through
  std::vector<bool> by_angle;  ///< what it absorbs depends on the angle
  bool any_emission = false;   ///< of a patch, or of a parallel source
  bool any_mirror = false;     ///< or pane, metal, glossy surface
  bool any_glossy = false;

  /// Share of its irradiance that a patch absorbs; 0 where its meetings with lines tell.
  double absorbed(std::size_t patch) const {
    if (by_angle[patch]) return 0;
    return left_over(1 - static_cast<double>(diffuse[patch]) - static_cast<double>(mirror[patch]) -
                     static_cast<double>(passed[patch]));
  }
};
/// Of broadband light.
PatchOptics patch_optics(const Scene& scene, const Hierarchy& hierarchy);
/// The same with the diffuse reflectances of a band.
PatchOptics patch_optics(const Scene& scene, const Hierarchy& hierarchy, std::size_t band);

}  // namespace sunload
