// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Direct sun by way of planar mirrors, once or several times reflected.
///
/// What comes to patches by one reflection of a sun that is a point is told by geometry
/// (solver/sight/mirrored_shares.h), the same in all realizations. For all else receivers look
/// along the image directions of the sun's beams (solver/first_light/sun_beams.h) from their sample
/// points, back from mirror to mirror and to the sun: every sample brings dni · Π rho_s · cosθ.
/// Light of mirrors that no beam stands for arrives on patches from where it is sent on
/// (solver/first_light/mirror_chains.h). Samples of a sun with a disk look at the images of
/// their own points on it; cosθ stays that of its centre.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/first_light/direct_sun.h"
#include "solver/first_light/sun_beams.h"
#include "solver/sight/mirrored_shares.h"

namespace sunload {

/// Each sun by way of its first mirrors; points into `beams`.
std::vector<std::vector<MirroredSun>> once_reflected(std::span<const SunBeams> beams);

class MirrorSun {
 public:
  /// All arguments must outlive it.
  MirrorSun(const RayCaster& caster, const MirrorGroups& groups, const LitShares& shares);

  /// Adds what the beams of each sun of the block bring to the receivers. Returns the rays cast.
  std::uint64_t add_light(const SunSampler& receivers, std::span<const IntervalLight> block,
                          std::span<const SunBeams> beams, const RaySink& into) const;

 private:
  class PatchWork;
  Columns known_of(std::span<const IntervalLight> block, std::span<const SunBeams> beams) const;

  const RayCaster& caster_;
  const MirrorGroups& groups_;
  MirroredShares shares_;
};

}  // namespace sunload
