// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/traced/light_iteration.h"

#include <algorithm>
#include <array>
#include <utility>

#include "solver/base/stopwatch.h"
#include "solver/base/threads.h"
#include "solver/light/sun_samples.h"

namespace sunload {

namespace {

using Suns = std::span<const IntervalLight>;

/// The beams of each sun by way of mirrors; none where the scene has no mirrors. `shares`: of
/// patches that see the suns.
std::vector<SunBeams> beams_of(const TracedScene& traced, Suns suns, const Columns& shares) {
  if (traced.mirrors.size() == 0) return {};
  std::vector<SunBeams> beams(suns.size(), SunBeams(traced.mirrors));
  parallel_for(suns.size(), [&](std::size_t k) {
    if (suns[k].dni > 0)
      beams[k] =
          beams_on_patches(traced, suns[k], traced.mirror_chains.dark_mirrors(suns[k], k, shares));
  });
  return beams;
}

std::vector<SunBeams> on_sensors(const TracedScene& traced, std::vector<SunBeams> beams,
                                 Suns suns) {
  parallel_for(beams.size(), [&](std::size_t k) {
    beams[k] = beams_on_sensors(traced, suns[k], std::move(beams[k]));
  });
  return beams;
}

RayLight empty_rays(const TracedScene& traced, std::size_t receivers, bool keep_columns) {
  RayLight rays;
  for (Columns* of : {&rays.pooled.direct, &rays.pooled.mirror, &rays.sunlit})
    *of = columns(receivers);
  if (keep_columns)
    rays.of_realizations = {static_cast<std::size_t>(traced.rules.realizations), receivers};
  return rays;
}

/// What kinds of rays bring to patches, or to sensors, over time.
class RayIntegrals {
 public:
  RayIntegrals(std::span<const TimedSums> sums, RaySums TimeSums::*receivers)
      : sums_(sums), receivers_(receivers) {}
  using Kind = std::vector<std::vector<double>> RaySums::*;
  std::vector<TimeIntegral> of(Kind kind) const {
    std::vector<TimeIntegral> all;
    for (const auto& [sums, seconds] : sums_) all.push_back({&(sums->*receivers_.*kind), seconds});
    return all;
  }
  std::vector<TimeIntegral> of_gloss() const {
    std::vector<TimeIntegral> all;
    for (const auto& [sums, seconds] : sums_) {
      RaySums& rays = sums->*receivers_;
      all.push_back({rays.gloss.empty() ? &rays.mirror : &rays.gloss, seconds});
    }
    return all;
  }

 private:
  std::span<const TimedSums> sums_;
  RaySums TimeSums::*receivers_;
};

RaySink sink(const TracedScene& traced, Columns& pooled, std::vector<TimeIntegral> integrals,
             std::vector<Columns>& of_realizations) {
  return {pooled, static_cast<std::size_t>(traced.rules.realizations), std::move(integrals),
          &of_realizations};
}

/// `shares`: of receivers that see the suns, or empty.
std::uint64_t add_sun(const TracedScene& traced, const Receivers& receivers, Suns suns,
                      const Columns& shares, RayLight& rays, const RayIntegrals& integrals) {
  return direct_sun(
      traced.caster, receivers.sampler, suns,
      sink(traced, rays.pooled.direct, integrals.of(&RaySums::direct), rays.of_realizations.direct),
      rays.sunlit, shares);
}

std::uint64_t add_circumsolar(const TracedScene& traced, const BlockSources& sources,
                              RayLight& rays, const RayIntegrals& integrals) {
  if (!any_circumsolar(sources.circumsolar)) return 0;
  rays.pooled.circumsolar = columns(traced.patches.count());
  return circumsolar_light(
      traced.caster, traced.patches.sampler, sources.suns, sources.circumsolar,
      sink(traced, rays.pooled.circumsolar, integrals.of(&RaySums::circumsolar),
           rays.of_realizations.circumsolar));
}

RaySink mirrored(const TracedScene& traced, RayLight& rays, std::vector<TimeIntegral> integrals) {
  return sink(traced, rays.pooled.mirror, std::move(integrals), rays.of_realizations.mirror);
}

void add_mirrors(const TracedScene& traced, Suns suns, const std::vector<SunBeams>& beams,
                 const Columns& shares, BlockRays& rays, const RayIntegrals& integrals,
                 WorkDone& work) {
  if (beams.empty()) return;
  const RaySink into = mirrored(traced, rays.on_patches, integrals.of(&RaySums::mirror));
  work.add(Work::mirror_rays,
           traced.mirror_sun.add_light(traced.patches.sampler, suns, beams, into));
  const auto chains = traced.mirror_chains.follow(suns, beams, shares, into);
  work.add(Work::mirror_rays, chains.rays);
  work.add(Work::mirror_shots, chains.shots);
  for (const auto& of_sun : beams) work.add(Work::mirror_beams, of_sun.size());
  rays.sent_on.resize(chains.fates.size());
  for (std::size_t r = 0; r < chains.fates.size(); ++r) rays.sent_on[r] += chains.fates[r];
}

void add_gloss(const TracedScene& traced, Suns suns, BlockRays& rays, const RayIntegrals& integrals,
               WorkDone& work) {
  if (!traced.optics.any_glossy) return;
  const Stopwatch time(work[Work::mirror_s]);
  work.add(Work::mirror_rays,
           traced.glossy_sun.add_light(traced.patches.lines, traced.lobe_images, suns,
                                       mirrored(traced, rays.on_patches, integrals.of_gloss())));
  rays.sent_on.resize(static_cast<std::size_t>(traced.rules.realizations));
  traced.glossy_sun.follow_light(suns, rays.sent_on);
}

/// Of narrow lobes: by samples, as mirrors are.
void add_lobe_images(const TracedScene& traced, Suns suns, BlockRays& rays,
                     const RayIntegrals& integrals, WorkDone& work) {
  if (!traced.optics.any_glossy) return;
  const Stopwatch time(work[Work::mirror_s]);
  work.add(Work::mirror_rays,
           traced.lobe_images.add_light(
               suns, mirrored(traced, rays.on_patches, integrals.of(&RaySums::mirror))));
}

using SunsOneByOne = std::vector<std::vector<IntervalLight>>;

bool are_points(Suns suns) {
  return std::ranges::all_of(suns, [](const auto& sun) { return sun.disk_half_angle <= 0; });
}

/// Of patches, where there are more suns than can be looked at one by one.
Columns shares_of_many(const TracedScene& traced, Suns suns) {
  return are_points(suns) ? traced.share_grid.of(suns)
                          : traced.lit_shares.of(suns, SendsOn::as_others);
}

std::vector<Columns> shares_of_patches(const TracedScene& traced, const SunsOneByOne& suns) {
  std::vector<Columns> shares;
  shares.reserve(suns.size());
  for (const auto& of_intervals : suns)
    shares.push_back(traced.lit_shares.of(of_intervals, traced.what_sends_on));
  return shares;
}

/// What is straight from the suns of intervals that have some for that alone. Returns the rays
/// cast.
std::uint64_t add_direct_suns(const TracedScene& traced, const Receivers& receivers, Suns block,
                              RayLight& rays, const RayIntegrals& integrals) {
  const RaySink into =
      sink(traced, rays.pooled.direct, integrals.of(&RaySums::direct), rays.of_realizations.direct);
  const bool are_patches = &receivers == &traced.patches;
  std::uint64_t cast = 0;
  const auto rows = direct_suns_in_rows(block);
  if (are_patches && are_points(block)) {
    std::vector<IntervalLight> all;
    for (const SunRow& row : rows) all.insert(all.end(), row.suns.begin(), row.suns.end());
    traced.share_grid.prepare(all);
  }
  for (const SunRow& row : rows)
    cast += direct_sun(traced.caster, receivers.sampler, row.suns, into.of_parts_of(row.interval),
                       rays.sunlit, are_patches ? shares_of_many(traced, row.suns) : Columns());
  return cast;
}

/// Patches that send light on.
std::vector<std::size_t> patches_that_send_on(const TracedScene& traced) {
  std::vector<std::size_t> patches;
  for (std::size_t i = 0; i < traced.patches.count(); ++i)
    if (sends_on(traced.scene.material_of(traced.hierarchy().patches()[i].triangle)))
      patches.push_back(i);
  return patches;
}

/// The same suns, night where an interval has suns for what is straight alone, or where it has not.
SunsOneByOne only(Suns block, SunsOneByOne suns, bool with_direct_suns) {
  for (auto& of_intervals : suns)
    for (std::size_t k = 0; k < block.size(); ++k)
      if (block[k].has_direct_suns() != with_direct_suns)
        of_intervals[k].sunlit_s = of_intervals[k].dni = 0;
  return suns;
}

/// Scales the few suns by which light is sent on, where there are more for what is straight, so
/// that in each interval surfaces that send it on get as much power by them as by all suns
/// (`by_all`, [N][block]): none is made or lost on the way. `by_few`: of each of `suns`.
void match_what_is_sent_on(const TracedScene& traced, Suns block, const Columns& by_all,
                           const std::vector<Columns>& by_few, SunsOneByOne& suns) {
  const auto senders = patches_that_send_on(traced);
  std::array<double, block_width> all{}, few{};
  for (const auto i : senders)
    for (std::size_t k = 0; k < block.size(); ++k) {
      const std::size_t at = i * block_width + k;
      all[k] += traced.hierarchy().area()[i] * static_cast<double>(by_all[at]);
      for (const Columns& by_sun : by_few)
        few[k] += traced.hierarchy().area()[i] * static_cast<double>(by_sun[at]);
    }
  for (auto& of_intervals : suns)
    for (std::size_t k = 0; k < of_intervals.size(); ++k)
      if (block[k].has_direct_suns() && few[k] > 0) of_intervals[k].dni *= all[k] / few[k];
}

/// `beams`: one set for each of `suns_one_by_one`. Returns the rays cast.
std::uint64_t add_mirrors_on_sensors(const TracedScene& traced, const SunsOneByOne& suns,
                                     std::vector<std::vector<SunBeams>> beams, RayLight& rays,
                                     const RayIntegrals& integrals) {
  const Receivers& sensors = traced.sensors;
  const RaySink into = mirrored(traced, rays, integrals.of(&RaySums::mirror));
  std::uint64_t cast = 0;
  for (std::size_t s = 0; s < suns.size(); ++s) {
    if (!beams[s].empty())
      cast += traced.mirror_sun.add_light(sensors.sampler, suns[s],
                                          on_sensors(traced, std::move(beams[s]), suns[s]), into);
    if (!traced.optics.any_glossy) continue;
    cast += traced.glossy_sun.add_light_on_sensors(sensors.lines, traced.lobe_images_of_sensors,
                                                   suns[s], into);
    cast += traced.lobe_images_of_sensors.add_light(suns[s], into);
  }
  return cast;
}

/// All that suns bring to sensors by rays. Returns the rays cast.
std::uint64_t light_sensors(const TracedScene& traced, Suns block, const SunsOneByOne& suns,
                            std::vector<std::vector<SunBeams>> beams, RayLight& rays,
                            const RayIntegrals& integrals) {
  std::uint64_t cast = add_direct_suns(traced, traced.sensors, block, rays, integrals);
  for (const auto& of_intervals : only(block, suns, false))
    cast += add_sun(traced, traced.sensors, of_intervals, {}, rays, integrals);
  return cast + add_mirrors_on_sensors(traced, suns, std::move(beams), rays, integrals);
}

/// Nobody wants any.
RayIntegrals no_integrals() { return {{}, &TimeSums::on_patches}; }

/// What is straight from the sun onto patches. Returns their shares that see the suns by which
/// light is sent on; these are scaled where there are more for what is straight.
std::vector<Columns> light_patches(const TracedScene& traced, Suns block, SunsOneByOne& suns,
                                   RayLight& rays, const RayIntegrals& integrals, WorkDone& work) {
  const Stopwatch time(work[Work::direct_s]);
  work.add(Work::direct_rays, add_direct_suns(traced, traced.patches, block, rays, integrals));
  const SunsOneByOne each = only(block, suns, false);
  auto shares = shares_of_patches(traced, each);
  for (std::size_t s = 0; s < suns.size(); ++s)
    work.add(Work::direct_rays,
             add_sun(traced, traced.patches, each[s], shares[s], rays, integrals));
  const bool sends_on = traced.mirrors.size() > 0 || traced.optics.any_glossy;
  if (!sends_on || !any_direct_suns(block)) return shares;
  const SunsOneByOne few = only(block, suns, true);
  std::vector<Columns> by_few;
  for (std::size_t s = 0; s < suns.size(); ++s) {
    const Columns of_few = shares_of_many(traced, few[s]);
    RayLight alone;
    alone.pooled.direct = alone.sunlit = columns(traced.patches.count());
    work.add(Work::direct_rays,
             add_sun(traced, traced.patches, few[s], of_few, alone, no_integrals()));
    by_few.push_back(std::move(alone.pooled.direct));
    for (std::size_t at = 0; at < of_few.size(); ++at) {
      const std::size_t k = at % block_width;
      if (k < block.size() && block[k].has_direct_suns()) shares[s][at] = of_few[at];
    }
  }
  match_what_is_sent_on(traced, block, rays.pooled.direct, by_few, suns);
  return shares;
}

}  // namespace

BlockRays light_iteration(const TracedScene& traced, const BlockSources& sources, const Kept& kept,
                          std::span<const TimedSums> sums, WorkDone& work) {
  auto suns = suns_one_by_one(sources.suns);
  const RayIntegrals of_patches(sums, &TimeSums::on_patches),
      of_sensors(sums, &TimeSums::on_sensors);
  BlockRays rays;
  rays.on_patches = empty_rays(traced, traced.patches.count(), kept.columns);
  // Nothing comes by mirrors that are not there.
  if (!kept.all_parts && traced.mirrors.size() == 0 && !traced.optics.any_glossy)
    rays.on_patches.of_realizations.mirror.clear();
  const auto shares = light_patches(traced, sources.suns, suns, rays.on_patches, of_patches, work);
  {
    const Stopwatch time(work[Work::direct_s]);
    work.add(Work::direct_rays, add_circumsolar(traced, sources, rays.on_patches, of_patches));
  }
  std::vector<std::vector<SunBeams>> beams(suns.size());
  for (std::size_t s = 0; s < shares.size(); ++s) {
    const Stopwatch time(work[Work::mirror_s]);
    beams[s] = beams_of(traced, suns[s], shares[s]);
    add_mirrors(traced, suns[s], beams[s], shares[s], rays, of_patches, work);
  }
  for (const auto& of_intervals : suns)
    add_lobe_images(traced, of_intervals, rays, of_patches, work);
  if (kept.by_samples) rays.on_patches.by_samples = summed(rays.on_patches.of_realizations);
  for (const auto& of_intervals : suns) add_gloss(traced, of_intervals, rays, of_patches, work);
  if (traced.sensors.count() == 0) return rays;
  const Stopwatch time(work[Work::sensors_s]);
  rays.on_sensors = empty_rays(traced, traced.sensors.count(), kept.columns);
  work.add(Work::sensor_rays, light_sensors(traced, sources.suns, suns, std::move(beams),
                                            rays.on_sensors, of_sensors));
  return rays;
}

SunBeams beams_on_patches(const TracedScene& traced, const IntervalLight& sun,
                          std::span<const std::uint8_t> dark) {
  const SolverRules& rules = traced.rules;
  SunBeams beams(
      traced.mirrors, sun,
      {rules.mirror_depth, rules.faint_glint, rules.most_sun_beams, traced.caster.offset_m()},
      dark);
  beams.follow_on(std::min(rules.unshot, rules.faint_glint), rules.most_sun_beams);
  return beams;
}

SunBeams beams_on_sensors(const TracedScene& traced, const IntervalLight& sun, SunBeams beams) {
  const SolverRules& rules = traced.rules;
  const double faint = std::min(rules.unshot, rules.faint_glint);
  if (beams.size() > 0) {
    beams.follow_on(faint, rules.most_faint_beams);
    return beams;
  }
  SunBeams of_sensors(
      traced.mirrors, sun,
      {rules.mirror_depth, faint, rules.most_faint_beams, traced.caster.offset_m()});
  if (of_sensors.size() > 0) return of_sensors;
  return SunBeams(
      traced.mirrors, sun,
      {.mirror_depth = std::min(rules.mirror_depth, 1), .most_beams = rules.most_sensor_beams});
}

std::vector<Columns> shares_of_patches(const TracedScene& traced, const BlockSources& sources,
                                       WorkDone& work) {
  const Stopwatch time(work[Work::direct_s]);
  return shares_of_patches(traced, suns_one_by_one(sources.suns));
}

RayLight direct_on_patches(const TracedScene& traced, const BlockSources& sources,
                           const std::vector<Columns>& shares, WorkDone& work) {
  const Stopwatch time(work[Work::direct_s]);
  const auto realizations = static_cast<std::size_t>(traced.rules.realizations);
  RayLight rays;
  rays.pooled.direct = rays.sunlit = columns(traced.patches.count());
  rays.of_realizations.direct.assign(realizations, columns(traced.patches.count()));
  const auto suns = suns_one_by_one(sources.suns);
  for (std::size_t s = 0; s < suns.size(); ++s)
    work.add(Work::direct_rays,
             add_sun(traced, traced.patches, suns[s], shares[s], rays, no_integrals()));
  return rays;
}

RayLight rays_on_sensors(const TracedScene& traced, const BlockSources& sources,
                         const std::vector<Columns>& shares, WorkDone& work) {
  const Stopwatch time(work[Work::sensors_s]);
  RayLight rays = empty_rays(traced, traced.sensors.count(), true);
  const auto suns = suns_one_by_one(sources.suns);
  std::vector<std::vector<SunBeams>> beams;
  beams.reserve(suns.size());
  for (std::size_t s = 0; s < suns.size(); ++s)
    beams.push_back(beams_of(traced, suns[s], shares[s]));
  work.add(Work::sensor_rays,
           light_sensors(traced, sources.suns, suns, std::move(beams), rays, no_integrals()));
  return rays;
}

}  // namespace sunload
