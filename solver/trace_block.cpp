// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What a block of suns brings by rays: shadow rays, image directions, chains of mirrors.
#include <algorithm>

#include "solver/base/stopwatch.h"
#include "solver/base/threads.h"
#include "solver/gather/traced_light.h"
#include "solver/solver.h"

namespace sunload {

TracedLight LightSolver::trace_block(const BlockSources& sources, TimeSums& sums) {
  TracedLight traced;
  make_columns(traced);
  trace_sun(sources, sums, traced);
  const MirroredIrradiance into{traced.by_mirror, sums.by_mirror,
                                or_none(traced.of_patches.by_mirror)};
  std::vector<SunBeams> beams = trace_mirrors(sources.suns, into, traced.sent_on);
  if (rules_.by_source) traced.by_samples = traced_sums(traced.of_patches);
  trace_gloss(sources.suns, {traced.by_mirror, sums.by_gloss, or_none(traced.of_patches.by_mirror)},
              traced.sent_on);
  if (!scene_.sensors.empty()) trace_sensors(sources.suns, std::move(beams), sums, traced);
  return traced;
}

void LightSolver::make_columns(TracedLight& traced) const {
  const bool of_instants = rules_.errors == Errors::instants;
  traced.by_mirror = columns(hierarchy_.patch_count());
  if (!of_instants && !is_rgb()) return;
  const auto realizations = static_cast<std::size_t>(rules_.realizations);
  traced.of_patches = {realizations, hierarchy_.patch_count()};
  traced.of_sensors = {realizations, scene_.sensors.size()};
  // Bands ask for time sums alone, to which nothing comes by mirrors that are not there.
  if (!of_instants && mirrors_.size() == 0 && !optics_.any_glossy)
    traced.of_patches.by_mirror.clear();
}

void LightSolver::trace_sun(const BlockSources& sources, TimeSums& sums, TracedLight& traced) {
  const Stopwatch time(work_.direct_s);
  traced.direct =
      direct_sun(caster_, sampler_, sources.suns, sums.direct, or_none(traced.of_patches.direct));
  traced.circumsolar = circumsolar_light(hierarchy_, caster_, sampler_, sources.suns,
                                         sources.circumsolar, traced.direct.sunlit,
                                         sums.circumsolar, or_none(traced.of_patches.circumsolar));
  work_.direct_rays += traced.direct.rays + traced.circumsolar.rays;
}

std::vector<SunBeams> LightSolver::trace_mirrors(std::span<const SunLight> block,
                                                 MirroredIrradiance into,
                                                 std::vector<SunFates>& sent_on) {
  if (mirrors_.size() == 0) return {};
  const Stopwatch time(work_.mirror_s);
  std::vector<SunBeams> beams = beams_of(block);
  work_.mirror_rays += mirror_sun_.add_light(sampler_, block, beams, into);
  auto followed = mirror_chains_.follow(block, beams, into);
  work_.mirror_rays += followed.rays;
  work_.mirror_shots += followed.shots;
  for (const auto& of_sun : beams) work_.mirror_beams += of_sun.size();
  sent_on = std::move(followed.fates);
  return beams;
}

std::vector<SunBeams> LightSolver::beams_of(std::span<const SunLight> block) const {
  const BeamRules rules{rules_.mirror_depth, rules_.faint_glint, rules_.most_sun_beams,
                        caster_.offset_m()};
  std::vector<SunBeams> beams(block.size(), SunBeams(mirrors_));
  parallel_for(block.size(),
               [&](std::size_t k) { beams[k] = SunBeams(mirrors_, block[k], rules); });
  return beams;
}

void LightSolver::trace_gloss(std::span<const SunLight> block, MirroredIrradiance into,
                              std::vector<SunFates>& sent_on) {
  if (!optics_.any_glossy) return;
  const Stopwatch time(work_.mirror_s);
  work_.mirror_rays += glossy_sun_.add_light(lines_, block, into);
  sent_on.resize(static_cast<std::size_t>(rules_.realizations));
  glossy_sun_.follow_light(block, sent_on);
}

void LightSolver::trace_sensors(std::span<const SunLight> block, std::vector<SunBeams> beams,
                                TimeSums& sums, TracedLight& traced) {
  const Stopwatch time(work_.sensors_s);
  traced.on_sensors = direct_sun(caster_, sensor_sampler_, block, sums.sensor_direct,
                                 or_none(traced.of_sensors.direct));
  work_.sensor_rays += traced.on_sensors.rays;
  traced.on_sensors_by_mirror = columns(scene_.sensors.size());
  const MirroredIrradiance into{traced.on_sensors_by_mirror, sums.sensor_by_mirror,
                                or_none(traced.of_sensors.by_mirror)};
  if (mirrors_.size() > 0)
    work_.sensor_rays += mirror_sun_.add_light(
        sensor_sampler_, block, with_first_reflections(std::move(beams), block), into);
  if (!optics_.any_glossy) return;
  work_.sensor_rays += glossy_sun_.add_light_on_sensors(sensor_lines_, lobe_images_, block, into);
  work_.sensor_rays += lobe_images_.add_light(block, into);
}

/// Suns of too many mirrors for beams (curved glass) get those of the first reflection: sensors are
/// few, and no chain of mirrors ends on them.
std::vector<SunBeams> LightSolver::with_first_reflections(std::vector<SunBeams> beams,
                                                          std::span<const SunLight> block) const {
  const BeamRules of_first{.mirror_depth = std::min(rules_.mirror_depth, 1),
                           .most_beams = rules_.most_sensor_beams};
  parallel_for(block.size(), [&](std::size_t k) {
    if (beams[k].size() == 0) beams[k] = SunBeams(mirrors_, block[k], of_first);
  });
  return beams;
}

}  // namespace sunload
