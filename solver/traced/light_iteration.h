// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The zeroth light iteration, E_0: what a block of suns brings by rays before any diffuse
/// reflection. Shadow rays, image directions and chains of mirrors, for patches and sensors alike.
#pragma once

#include <vector>

#include "solver/first_light/mirror_chains.h"
#include "solver/first_light/ray_light.h"
#include "solver/gather/block_light.h"
#include "solver/gather/time_sums.h"
#include "solver/light/work.h"
#include "solver/traced/traced_scene.h"

namespace sunload {

/// What of single realizations is kept beside the pooled light.
struct Kept {
  bool columns = false;     ///< RayLight::of_realizations
  bool all_parts = false;   ///< of these, parts too that the scene has not
  bool by_samples = false;  ///< RayLight::by_samples
};

struct BlockRays {
  RayLight on_patches, on_sensors;
  std::vector<SunFates> sent_on;  ///< [R] by mirrors and gloss, where the scene has any
};

/// Traces a block whose sky is split; adds what its rays bring over time to `sums`, by gloss onto
/// patches to the mirrors' where those have no sums of gloss.
BlockRays light_iteration(const TracedScene& traced, const BlockSources& sources, const Kept& kept,
                          std::span<const TimedSums> sums, WorkDone& work);

/// LitShares::of the block, one for each of `suns_one_by_one`.
std::vector<Columns> shares_of_patches(const TracedScene& traced, const BlockSources& sources,
                                       WorkDone& work);
/// The same as `light_iteration` of the sun alone, straight, on patches: the columns of the
/// realizations. `shares`: shares_of_patches.
RayLight direct_on_patches(const TracedScene& traced, const BlockSources& sources,
                           const std::vector<Columns>& shares, WorkDone& work);
/// Of the sun on sensors, straight, by mirrors and by gloss: as part of `light_iteration`.
RayLight rays_on_sensors(const TracedScene& traced, const BlockSources& sources,
                         const std::vector<Columns>& shares, WorkDone& work);

}  // namespace sunload
