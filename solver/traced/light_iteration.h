// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The zeroth light iteration, E_0: what a block of suns brings by rays before any diffuse
/// reflection. Shadow rays, image directions and chains of mirrors, for patches and sensors alike.
#pragma once

#include <vector>

#include "solver/first_light/mirror_chains.h"
#include "solver/first_light/ray_light.h"
#include "solver/first_light/sun_beams.h"
#include "solver/gather/block_light.h"
#include "solver/gather/time_sums.h"
#include "solver/light/work.h"
#include "solver/traced/traced_scene.h"

namespace sunload {

/// What of single realizations is kept beside the pooled light.
struct Kept {
  bool columns = false;     ///< RayLight::of_realizations
  bool all_parts = false;   ///< of these, also parts that the scene does not have
  bool by_samples = false;  ///< RayLight::by_samples
};

/// What the rays of one block brought to both kinds of receivers.
struct BlockRays {
  RayLight on_patches, on_sensors;
  std::vector<SunFates> sent_on;  ///< [R] by mirrors and gloss, where the scene has any
};

/// Traces a block whose sky is split, and adds what its rays bring over time to `sums`. Light by
/// gloss onto patches is added to that by mirrors where the sums have no gloss of their own.
BlockRays light_iteration(const TracedScene& traced, const BlockSources& sources, const Kept& kept,
                          std::span<const TimedSums> sums, WorkDone& work);

/// LitShares::of the block, one for each of `suns_one_by_one`.
std::vector<Columns> shares_of_patches(const TracedScene& traced, const BlockSources& sources,
                                       WorkDone& work);
/// The beams of a sun that patches ask: down to `unshot` of it where no more than `most_sun_beams`
/// are there, so that no light is left to chains; else to `faint_glint`. `dark`: as of SunBeams.
SunBeams beams_on_patches(const TracedScene& traced, const IntervalLight& sun,
                          std::span<const std::uint8_t> dark = {});
/// The beams of a sun that sensors ask: no chains of mirrors end on them, so that these go on to
/// fainter reflections than `beams` of patches. Suns of too many mirrors for beams
/// (curved glass) get those of the first reflection: sensors are few.
SunBeams beams_on_sensors(const TracedScene& traced, const IntervalLight& sun, SunBeams beams);
/// Only the straight sun on patches, as `light_iteration` has it: the columns of the realizations.
/// `shares`: shares_of_patches.
RayLight direct_on_patches(const TracedScene& traced, const BlockSources& sources,
                           const std::vector<Columns>& shares, WorkDone& work);
/// Only the sun on sensors, straight, by mirrors and by gloss, as `light_iteration` has it.
RayLight rays_on_sensors(const TracedScene& traced, const BlockSources& sources,
                         const std::vector<Columns>& shares, WorkDone& work);

}  // namespace sunload
