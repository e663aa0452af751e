// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Light of lamps that are no surfaces of the scene: finite parallel emitters
/// (solver/first_light/parallel_beams.h) and luminaires (solver/first_light/luminaire_points.h).
///
/// They take no part in intersection tests. Their light is constant in time, and known once and
/// for all: every patch samples it by points of its own, like the sun, and what mirrors send on of
/// it is followed and left on the patches that it meets.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/first_light/direct_sun.h"
#include "solver/light/tally.h"
#include "solver/mesh/patch_optics.h"
#include "solver/surface/mirror_groups.h"

namespace sunload {

/// What these lamps bring to N receivers, of every realization or pooled. All empty where the scene
/// has no such lamp.
struct LampLight {
  std::vector<std::vector<double>> irradiance;  ///< [R][N], straight and by mirrors [W m-2]
  std::vector<double> pooled;                   ///< [N]
  /// [R] what meets the scene, and what mirrors send on [W].
  std::vector<Ledger> ledger;
  std::uint64_t rays = 0;
  /// Irradiance of realization r, or empty.
  const std::vector<double>& of(std::size_t r) const {
    return irradiance.empty() ? pooled : irradiance[r];
  }
};

/// Empty where the scene has no such lamps. Cost: a ray for each sample of a patch and lamp that
/// may see each other.
LampLight lamp_light(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
                     const SunSampler& sampler, const PatchOptics& optics, std::size_t realizations,
                     int mirror_depth);
/// The same on sensors; by mirrors that of luminaires alone, once reflected
/// (solver/first_light/luminaire_images.h). No ledger.
LampLight lamp_light_on_sensors(const Scene& scene, const RayCaster& caster,
                                const SunSampler& sensors, const MirrorGroups& mirrors,
                                std::size_t realizations);

}  // namespace sunload
