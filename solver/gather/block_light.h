// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Light of one block of suns on one set of lines: light iteration and Jacobi.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "solver/base/chunks.h"
#include "solver/base/threads.h"
#include "solver/first_light/circumsolar.h"
#include "solver/first_light/ray_light.h"
#include "solver/gather/jacobi.h"
#include "solver/gather/ledger.h"
#include "solver/light/sun_block.h"
#include "solver/lines/lines.h"

namespace sunload {

/// Sources of a block that do not depend on the patch.
struct BlockSources {
  /// Of up to `block_width` suns. Throws std::logic_error for light that is none (expect_valid).
  explicit BlockSources(std::span<const IntervalLight> suns, std::size_t sky_cells);
  /// From now on the lines carry the sky without its circumsolar part.
  void split_sky(const SkyGrid& grid);
  std::span<const IntervalLight> suns;
  Columns sky;                              ///< [cells][block] π·radiance, by way of mirrors
  Columns sky_of_lines;                     ///< the same, straight
  std::vector<CircumsolarSky> circumsolar;  ///< per sun, after split_sky
  /// Factor of `circumsolar`: 1, or that of a band.
  std::array<double, block_width> circumsolar_factor;
  /// Radiance of a cell as the lines see it [W m-2 sr-1], after split_sky.
  double radiance_for_lines(std::size_t k, std::size_t cell) const {
    const double taken = circumsolar_factor[k] * circumsolar[k].radiance(cell);
    return std::max(0.0, suns[k].sky[cell] - taken);  // below 0 by a rounding only
  }
  float ground_exitance[block_width] = {};
};

/// Irradiance of a block by parts, [N][block] W m-2.
struct BlockLight {
  Columns direct, sky, mirror, reflected;
  Columns gathered_radiosity;  ///< radiosity gathered last
  Columns last;                ///< part of `reflected` by the last bounce; empty: no bounce
  Columns estimated;           ///< part of `reflected` that bounces do not follow; empty: none
  std::vector<float> lamps;    ///< [N], the same for all suns

  float total(std::size_t patch, std::size_t k) const {
    const std::size_t at = patch * block_width + k;
    return direct[at] + sky[at] + mirror[at] + lamps[patch] + reflected[at];
  }
};

/// Light that follows no links: the sun's rays, straight and by mirrors, emitters that the rows of
/// `lines` meet, and parallel sources ([N], or empty).
BlockLight light_by_rays(const LineSet& lines, RayColumns rays,
                         const std::vector<double>& parallel);

/// Light of the far ground alone, [N][block].
Columns far_ground_light(const LineSet& lines, const BlockSources& sources);

/// Light that arrives at the rows of `lines` without diffuse reflection by patches: along these
/// lines, by `rays`, and from parallel sources ([N], or empty). `reflected` holds the far ground
/// alone, `gathered_radiosity` nothing.
BlockLight unreflected_light(const LineSet& lines, const PatchOptics& optics,
                             const BlockSources& sources, RayColumns rays,
                             const std::vector<double>& parallel);

/// The same, and the light that patches reflect.
BlockLight block_light(const Hierarchy& mesh, const LineSet& lines, const PatchOptics& optics,
                       const BlockSources& sources, RayColumns rays,
                       const std::vector<double>& parallel, const BounceRules& rules);

/// rho E of every patch, with E all of its light; 0 for elements above the patches. `Light`: of a
/// block, with total(patch, sun).
template <class Light>
Columns reflected_radiosity(const PatchOptics& optics, const Light& light, std::size_t elements) {
  Columns radiosity = columns(elements);
  parallel_for(
      optics.diffuse.size(),
      [&](std::size_t i) {
        for (std::size_t k = 0; k < block_width; ++k)
          radiosity[i * block_width + k] =
              optics.diffuse[i] * static_cast<float>(light.total(i, k));
      },
      receivers_per_chunk);
  return radiosity;
}

/// Diffusely reflected radiosity of all elements in all of their light.
Columns radiosity_of_all_light(const Hierarchy& mesh, const PatchOptics& optics,
                               const BlockLight& light);
/// Diffusely reflected radiosity of all elements as sensors see it: the radiosity that was gathered
/// last or, where the light beyond the last bounce is estimated, that of all light.
/// `gathered_radiosity` is used up.
Columns seen_radiosity(const Hierarchy& mesh, const PatchOptics& optics, BlockLight& light);

/// Ledger of every sun of the block [W], but for the sun's light sent on by mirrors.
std::vector<Ledger> block_ledger(const LineSet& lines, const PatchOptics& optics,
                                 const std::vector<double>& area, const BlockSources& sources,
                                 const BlockLight& light);

}  // namespace sunload
