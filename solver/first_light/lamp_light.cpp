// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/first_light/lamp_light.h"

#include "solver/base/chunks.h"
#include "solver/base/threads.h"
#include "solver/first_light/luminaire_images.h"
#include "solver/first_light/luminaire_points.h"
#include "solver/first_light/parallel_beams.h"

namespace sunload {

namespace {

/// All lamps of a scene.
class Lamps {
 public:
  explicit Lamps(const Scene& scene) : beams_(scene.parallel_sources), points_(scene.luminaires) {}
  void shine_on(std::size_t receiver, LampRays& rays) const {
    beams_.shine_on(receiver, rays);
    points_.shine_on(receiver, rays);
  }

 private:
  ParallelBeams beams_;
  LuminairePoints points_;
};

/// Means of the realizations.
void pool(LampLight& light, std::size_t receivers) {
  light.pooled.assign(receivers, 0);
  for (const auto& E : light.irradiance)
    for (std::size_t i = 0; i < receivers; ++i)
      light.pooled[i] += E[i] / static_cast<double>(light.irradiance.size());
}

}  // namespace

LampLight lamp_light(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
                     const SunSampler& sampler, const PatchOptics& optics, std::size_t realizations,
                     int mirror_depth) {
  LampLight light;
  if (!scene.any_lamp_beside_surfaces()) return light;
  const std::size_t patches = hierarchy.patch_count();
  light.irradiance.assign(realizations, std::vector<double>(patches, 0));
  light.ledger.resize(realizations);
  const Lamps lamps(scene);
  const SkyGrid smallest_grid(2);  // where the light leaves is not asked
  const LineFollower follower(scene, hierarchy, caster, smallest_grid, mirror_depth);
  const LampRays::Surfaces surfaces{hierarchy, optics, follower};

  std::vector<LampRays::Found> parts(chunk_count(patches, receivers_per_chunk));
  parallel_chunks(patches, receivers_per_chunk, [&](std::size_t begin, std::size_t end) {
    LampRays rays(caster, sampler, &surfaces, light.irradiance);
    for (std::size_t i = begin; i < end; ++i) lamps.shine_on(i, rays);
    parts[begin / receivers_per_chunk] = std::move(rays.found());
  });
  // After the loop: patches of other tasks are met.
  for (const auto& part : parts) {
    light.rays += part.rays;
    for (std::size_t r = 0; r < realizations; ++r) light.ledger[r] += part.ledger[r];
    for (const auto& [r, patch, power] : part.left)
      light.irradiance[r][patch] += power / hierarchy.area()[patch];
  }
  pool(light, patches);
  return light;
}

LampLight lamp_light_on_sensors(const Scene& scene, const RayCaster& caster,
                                const SunSampler& sensors, const MirrorGroups& mirrors,
                                std::size_t realizations) {
  LampLight light;
  if (!scene.any_lamp_beside_surfaces()) return light;
  light.irradiance.assign(realizations, std::vector<double>(sensors.receivers(), 0));
  const Lamps lamps(scene);
  LampRays rays(caster, sensors, nullptr, light.irradiance);
  for (std::size_t s = 0; s < sensors.receivers(); ++s) lamps.shine_on(s, rays);
  light.rays = rays.found().rays;
  if (scene.luminaires.any()) {
    const LuminaireImages images(mirrors, caster);
    for (std::size_t s = 0; s < sensors.receivers(); ++s) {
      const double E = images.on(scene.sensors[s], light.rays);
      for (auto& of_realization : light.irradiance) of_realization[s] += E;
    }
  }
  pool(light, sensors.receivers());
  return light;
}

}  // namespace sunload
