/// Light of one block of suns on one set of lines: light iteration and Jacobi.
#pragma once

#include <span>
#include <vector>

#include "solver/jacobi.h"
#include "solver/ledger.h"
#include "solver/lines.h"
#include "solver/sun_block.h"

namespace sunload {

/// Sources of a block that do not depend on the patch.
struct BlockSources {
  explicit BlockSources(std::span<const SunLight> suns, std::size_t sky_cells);
  std::span<const SunLight> suns;
  Columns sky;                                   ///< [cells][block] π·radiance
  float ground_exitance[block_width] = {};
};

/// Irradiance of a block by parts, [N][block] W m-2.
struct BlockLight {
  Columns direct, sky, mirror, reflected;
  Columns followed;           ///< radiosity gathered last
  std::vector<float> lamps;   ///< [N], the same for all suns

  float total(std::size_t patch, std::size_t k) const {
    const std::size_t at = patch * block_width + k;
    return direct[at] + sky[at] + mirror[at] + lamps[patch] + reflected[at];
  }
};

/// What arrives at the rows of `lines` without diffuse reflection by patches; `reflected`
/// holds the far ground alone, `followed` nothing.
BlockLight first_light(const Hierarchy& mesh, const LineSet& lines, const PatchOptics& optics,
                       const BlockSources& sources, Columns direct, Columns sun_by_mirror);

/// direct, sun_by_mirror: irradiance of the sun, straight and by mirrors.
BlockLight block_light(const Hierarchy& mesh, const LineSet& lines, const PatchOptics& optics,
                       const BlockSources& sources, Columns direct, Columns sun_by_mirror,
                       int bounces);

/// Ledger of every sun of the block [W], but for the sun's light sent on by mirrors.
std::vector<Ledger> block_ledger(const LineSet& lines, const PatchOptics& optics,
                                 const std::vector<double>& area, const BlockSources& sources,
                                 const BlockLight& light);

}  // namespace sunload
