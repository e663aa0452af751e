#include "solver/solver.h"

#include <algorithm>

#include "geo/check.h"
#include "geo/units.h"
#include "solver/guide.h"
#include "solver/instant_spread.h"
#include "solver/parallel.h"
#include "solver/sensor_light.h"
#include "solver/shooting.h"
#include "solver/stopwatch.h"

namespace sunload {

namespace {

constexpr std::size_t patches_per_task = 1024;

LineRules line_rules(const SolverRules& rules) {
  return {rules.lines_per_patch, rules.realizations, rules.mirror_depth, rules.seed,
          rules.link_threshold / rules.lines_per_patch};
}

Lines timed_lines(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
                  const SkyGrid& grid, const PatchOptics& optics, const SolverRules& rules,
                  Watch& watch, WorkDone& work) {
  const Stopwatch time(work.lines_s);
  Guide guide;  // shooting samples emitters in its own way
  if (rules.transport == Transport::gather)
    guide = lit_surfaces(scene, hierarchy, caster, grid, optics, line_rules(rules), rules.bounces);
  Lines lines = trace_lines(scene, hierarchy, caster, grid, guide, line_rules(rules), watch);
  work.line_rays = lines.rays;
  return lines;
}

Lines timed_sensor_lines(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
                         const SkyGrid& grid, const PatchOptics& optics, const SolverRules& rules,
                         WorkDone& work) {
  const Stopwatch time(work.sensors_s);
  Lines lines = trace_sensor_lines(scene, hierarchy, caster, grid,
                                   emitting_surfaces(scene, hierarchy, optics), line_rules(rules));
  work.sensor_rays = lines.rays;
  return lines;
}

/// Adds the light of a block to what receivers get.
void store_received(const BlockLight& light, std::span<const SunLight> block,
                    std::size_t first_row, const Columns& sunlit, ReceiverTally& tally) {
  const std::size_t receivers = tally.sunlit_s.size();
  const auto put = [&](Part part, std::size_t i, std::size_t k, float value) {
    const auto p = static_cast<std::size_t>(part);
    if (tally.irradiance[p].empty()) return;
    tally.irradiance[p][(first_row + k) * receivers + i] = value;
    tally.exposure[p][i] += static_cast<double>(value) * block[k].length_s;
  };
  parallel_for(receivers, [&](std::size_t i) {
    for (std::size_t k = 0; k < block.size(); ++k) {
      const std::size_t at = i * block_width + k;
      const float total = light.total(i, k);
      put(Part::total, i, k, total);
      put(Part::direct, i, k, light.direct[at]);
      put(Part::sky, i, k, light.sky[at]);
      put(Part::mirror, i, k, light.mirror[at]);
      put(Part::lamps, i, k, light.lamps[i]);
      put(Part::reflected, i, k, light.reflected[at]);
      tally.sunlit_s[i] += static_cast<double>(sunlit[at]) * block[k].sunlit_s;
      tally.irradiance_max[i] = std::max(tally.irradiance_max[i], total);
    }
  }, patches_per_task);
}

Ledger sun_sent_on(const MirroredSun& fate, std::size_t k) {
  Ledger ledger;
  ledger[Term::escaped] = fate.escaped[k];
  ledger[Term::absorbed] = fate.backs[k] + fate.absorbed[k];
  ledger[Term::transmitted] = fate.transmitted[k];
  ledger.lost_at_backs = fate.backs[k];
  ledger[Term::unshot] = fate.cut[k];
  return ledger;
}

}  // namespace

/// Sources of a batch integrated over time, per realization where they are
/// estimates of their own [J m-2], [J].
struct LightSolver::TimeSums {
  std::vector<std::vector<double>> direct, by_mirror;  ///< [R][N]
  std::vector<std::vector<double>> circumsolar;        ///< [R][N]
  std::vector<std::vector<double>> sensor_direct, sensor_by_mirror;  ///< [R][sensors]
  std::vector<double> sky;                             ///< [cells] π·radiance·time
  std::vector<double> sky_of_lines;                    ///< the same without circumsolar light
  double ground = 0;
  double length_s = 0;                                 ///< for lamps
  std::vector<Ledger> sent_on;                         ///< [R] the sun's light that mirrors sent on
};

/// The sun's irradiance of each realization, straight and by mirrors; empty where errors per
/// instant are not asked for.
struct LightSolver::SunColumns {
  std::vector<Columns> direct, by_mirror, circumsolar;
  SunColumns(std::size_t realizations, std::size_t receivers)
      : direct(realizations, columns(receivers)), by_mirror(direct), circumsolar(direct) {}
  std::vector<Columns>* direct_or_none() { return direct.empty() ? nullptr : &direct; }
  std::vector<Columns>* circumsolar_or_none() {
    return circumsolar.empty() ? nullptr : &circumsolar;
  }
  std::vector<Columns>* by_mirror_or_none() { return by_mirror.empty() ? nullptr : &by_mirror; }
};

namespace {

/// Time-integrated irradiance of one realization before any diffuse reflection [J m-2].
struct FirstExposure {
  std::vector<double> sky, base, ground;  ///< straight from the sky; all but ground; far ground
};

/// `sky_of_lines`: what of the sky the lines take; `circumsolar`: the rest, or empty.
template <class Sums>
FirstExposure first_exposure(const LineSet& lines, const PatchOptics& optics, const Sums& sums,
                             const std::vector<double>& sky_of_lines,
                             const std::vector<double>& direct,
                             const std::vector<double>& by_mirror,
                             const std::vector<double>& circumsolar,
                             const std::vector<double>& parallel) {
  const std::size_t rows = lines.ends.size();
  FirstExposure first{std::vector<double>(rows, 0), std::vector<double>(rows, 0),
                      std::vector<double>(rows, 0)};
  gather(lines.sky, sky_of_lines, first.sky, Into::replace);
  if (optics.any_mirror) gather(lines.sky_by_mirror, sums.sky, first.base, Into::add);
  for (const auto* lamps : {&lines.lamps, &parallel})
    for (std::size_t i = 0; i < lamps->size(); ++i) first.base[i] += (*lamps)[i] * sums.length_s;
  for (std::size_t i = 0; i < circumsolar.size(); ++i) first.sky[i] += circumsolar[i];
  for (std::size_t i = 0; i < rows; ++i) {
    first.base[i] += direct[i] + by_mirror[i] + first.sky[i];
    first.ground[i] = static_cast<double>(lines.ends[i].ground + lines.ends[i].ground_by_mirror) *
                      sums.ground;
  }
  return first;
}

}  // namespace

LightSolver::LightSolver(const Scene& scene, const SplitRules& split, const SolverRules& rules,
                         Watch& watch, std::optional<Lines> ready)
    : LightSolver(scene, std::make_shared<const Hierarchy>(scene, split), rules, watch,
                  std::move(ready)) {}

LightSolver::LightSolver(const Scene& scene, std::shared_ptr<const Hierarchy> mesh,
                         const SolverRules& rules, Watch& watch, std::optional<Lines> ready)
    : scene_(scene),
      rules_(rules),
      mesh_(std::move(mesh)),
      hierarchy_(*mesh_),
      caster_(scene.mesh, rules.isa, screens(scene)),
      optics_(patch_optics(scene, hierarchy_)),
      lines_(ready ? std::move(*ready)
                   : timed_lines(scene, hierarchy_, caster_, grid_, optics_, rules, watch, work_)),
      sensor_lines_(timed_sensor_lines(scene, hierarchy_, caster_, grid_, optics_, rules, work_)),
      sampler_(hierarchy_, caster_, {rules.direct_samples, rules.realizations, rules.seed}),
      sensor_sampler_(scene.sensors, caster_,
                      {rules.direct_samples, rules.realizations, rules.seed}),
      mirrors_(scene),
      mirror_sun_(caster_, mirrors_),
      mirror_chains_(hierarchy_, caster_, sampler_, mirrors_, {rules.mirror_depth, rules.unshot}),
      parallel_(parallel_light(scene, hierarchy_, caster_, sampler_, optics_,
                               static_cast<std::size_t>(rules.realizations), rules.mirror_depth)),
      sensor_parallel_(parallel_light_on_sensors(scene, caster_, sensor_sampler_,
                                                 static_cast<std::size_t>(rules.realizations))),
      glossy_sun_(scene, hierarchy_, caster_, sampler_, optics_, lines_, line_rules(rules)),
      bounces_(bounces_needed(hierarchy_, lines_.pooled, optics_, rules.bounces,
                              rules.unshot)) {
  work_.direct_rays += parallel_.rays;
  if (rules.transport != Transport::shoot) return;
  const Stopwatch time(work_.shoot_s);
  shooter_ = std::make_unique<Shooter>(
      scene, hierarchy_, caster_, sampler_, grid_, lines_, line_rules(rules),
      ShootingRules{bounces_, rules.jacobi, rules.power_per_sample_w});
  work_.shot_rays = shooter_->rays();
  work_.samples = shooter_->samples();
}

LightSolver::~LightSolver() = default;

bool LightSolver::has_part(Part part) const {
  if (part == Part::mirror) return optics_.any_mirror;
  if (part == Part::lamps) return optics_.any_emission;
  return true;
}

std::vector<double> LightSolver::sky_view_factor() const {
  std::vector<double> share;
  for (const auto& ends : lines_.pooled.ends) share.push_back(static_cast<double>(ends.sky));
  return share;
}

BatchTally LightSolver::solve(std::span<const SunLight> batch, Watch& watch) {
  const std::size_t patches = hierarchy_.patch_count();
  const auto realizations = static_cast<std::size_t>(rules_.realizations);
  BatchTally tally = empty_tally(batch);
  TimeSums sums;
  sums.direct.assign(realizations, std::vector<double>(patches, 0));
  sums.by_mirror = sums.circumsolar = sums.direct;
  sums.sensor_direct.assign(realizations, std::vector<double>(scene_.sensors.size(), 0));
  sums.sensor_by_mirror = sums.sensor_direct;
  sums.sky.assign(static_cast<std::size_t>(grid_.cell_count()), 0);
  sums.sky_of_lines = sums.sky;
  sums.sent_on.resize(realizations);

  // Consecutive intervals with light, up to one block at a time.
  const auto lit = [&](std::size_t k) { return optics_.any_emission || !batch[k].is_dark(); };
  for (std::size_t begin = 0; begin < batch.size();) {
    std::size_t end = begin;
    while (end < batch.size() && end - begin < block_width && lit(end)) ++end;
    const auto block = batch.subspan(begin, end - begin);
    if (!block.empty() && shooter_) shoot_block(block, begin, tally);
    if (!block.empty() && !shooter_) solve_block(block, begin, sums, tally);
    begin = std::max(end, begin + 1);
    watch.advance(Stage::light, static_cast<double>(begin) / static_cast<double>(batch.size()));
  }

  for (std::size_t k = 0; k < batch.size(); ++k)
    tally.energy += scaled(tally.ledger[k], batch[k].length_s);

  if (shooter_) return tally;  // its realizations have their totals from their series
  const Stopwatch time(work_.realizations_s);
  for (std::size_t r = 0; r < realizations; ++r) {
    solve_realization(r, sums, tally);
    for (std::size_t i = 0; i < patches; ++i)
      sums.direct[r][i] += sums.by_mirror[r][i] + sums.circumsolar[r][i];
  }
  tally.sun_realization = std::move(sums.direct);
  return tally;
}

void LightSolver::solve_block(std::span<const SunLight> block, std::size_t first_row,
                              TimeSums& sums, BatchTally& tally) {
  const std::size_t patches = hierarchy_.patch_count();
  const auto realizations = static_cast<std::size_t>(rules_.realizations);
  BlockSources sources(block, static_cast<std::size_t>(grid_.cell_count()));
  sources.split_sky(grid_);
  const bool per_instant = rules_.errors == Errors::instants;
  SunColumns of_patches(per_instant ? realizations : 0, patches);
  SunColumns of_sensors(per_instant ? realizations : 0, scene_.sensors.size());

  DirectSun direct;
  CircumsolarLight circumsolar;
  {
    const Stopwatch time(work_.direct_s);
    direct = direct_sun(caster_, sampler_, block, sums.direct, of_patches.direct_or_none());
    circumsolar = circumsolar_light(hierarchy_, caster_, sampler_, block, sources.circumsolar,
                                    direct.sunlit, sums.circumsolar,
                                    of_patches.circumsolar_or_none());
    work_.direct_rays += direct.rays + circumsolar.rays;
  }
  Columns by_mirror = columns(patches);
  std::vector<SunBeams> beams;
  std::vector<MirroredSun> sent_on;
  if (mirrors_.size() > 0) {
    const Stopwatch time(work_.mirror_s);
    const MirroredIrradiance into{by_mirror, sums.by_mirror, of_patches.by_mirror_or_none()};
    beams = beams_of(block);
    work_.mirror_rays += mirror_sun_.add_light(sampler_, block, beams, into);
    auto followed = mirror_chains_.follow(block, beams, into);
    work_.mirror_rays += followed.rays;
    work_.mirror_shots += followed.shots;
    for (const auto& of_sun : beams) work_.mirror_beams += of_sun.size();
    sent_on = std::move(followed.fates);
  }
  if (optics_.any_glossy) {
    const Stopwatch time(work_.mirror_s);
    work_.mirror_rays += glossy_sun_.add_light(
        block, {by_mirror, sums.by_mirror, of_patches.by_mirror_or_none()});
    sent_on.resize(realizations);
    glossy_sun_.follow_light(block, sent_on);
  }
  Columns followed;
  {
    const Stopwatch time(work_.solve_s);
    BlockLight light = block_light(hierarchy_, lines_.pooled, optics_, sources,
                                   {std::move(direct.irradiance), std::move(by_mirror),
                                    circumsolar.irradiance, parallel_.pooled},
                                   bounces_);
    const auto ledger = block_ledger(lines_.pooled, optics_, hierarchy_.area(), sources, light);
    std::copy(ledger.begin(), ledger.end(),
              tally.ledger.begin() + static_cast<std::ptrdiff_t>(first_row));
    store(light, block, first_row, direct.sunlit, tally);
    followed = std::move(light.followed);
  }
  if (!scene_.sensors.empty())
    solve_sensors(sources, beams, followed, first_row, sums, of_sensors, tally.sensors);
  for (std::size_t r = 0; r < sent_on.size(); ++r)
    for (std::size_t k = 0; k < block.size(); ++k) {
      const Ledger fate = sun_sent_on(sent_on[r], k);
      tally.ledger[first_row + k] += scaled(fate, 1.0 / static_cast<double>(realizations));
      sums.sent_on[r] += scaled(fate, block[k].length_s);
    }
  for (std::size_t r = 0; r < parallel_.ledger.size(); ++r)
    for (std::size_t k = 0; k < block.size(); ++k)
      tally.ledger[first_row + k] +=
          scaled(parallel_.ledger[r], 1.0 / static_cast<double>(realizations));
  for (std::size_t k = 0; k < block.size(); ++k) {
    const SunLight& sun = block[k];
    for (std::size_t c = 0; c < sun.sky.size(); ++c) {
      sums.sky[c] += pi * sun.sky[c] * sun.length_s;
      sums.sky_of_lines[c] +=
          pi * (sun.sky[c] - sources.circumsolar[k].radiance(c)) * sun.length_s;
    }
    sums.ground += sun.ground_exitance * sun.length_s;
    sums.length_s += sun.length_s;
  }
  if (per_instant) {
    errors_per_instant(sources, first_row, of_patches, of_sensors, tally);
    for (std::size_t r = 0; r < sent_on.size(); ++r)
      for (std::size_t k = 0; k < block.size(); ++k)
        tally.ledger_instants[r][first_row + k] += sun_sent_on(sent_on[r], k);
    for (std::size_t r = 0; r < parallel_.ledger.size(); ++r)
      for (std::size_t k = 0; k < block.size(); ++k)
        tally.ledger_instants[r][first_row + k] += parallel_.ledger[r];
  }
}

std::vector<SunBeams> LightSolver::beams_of(std::span<const SunLight> block) const {
  const BeamRules rules{rules_.mirror_depth, rules_.faint_glint, rules_.most_sun_beams,
                        caster_.offset_m()};
  std::vector<SunBeams> beams(block.size(), SunBeams(mirrors_));
  parallel_for(block.size(), [&](std::size_t k) { beams[k] = SunBeams(mirrors_, block[k], rules); });
  return beams;
}

void LightSolver::store(const BlockLight& light, std::span<const SunLight> block,
                        std::size_t first_row, const Columns& sunlit, BatchTally& tally) const {
  store_received(light, block, first_row, sunlit, tally);
  parallel_for(hierarchy_.patch_count(), [&](std::size_t i) {
    for (std::size_t k = 0; k < block.size(); ++k)
      tally.outgoing[i] +=
          static_cast<double>(optics_.diffuse[i] * light.total(i, k) + optics_.emission[i]) *
          block[k].length_s;
  }, patches_per_task);
}

void LightSolver::solve_sensors(const BlockSources& sources, std::span<const SunBeams> beams,
                                const Columns& followed, std::size_t first_row, TimeSums& sums,
                                SunColumns& of_realizations, ReceiverTally& tally) {
  const Stopwatch time(work_.sensors_s);
  DirectSun direct = direct_sun(caster_, sensor_sampler_, sources.suns, sums.sensor_direct,
                                of_realizations.direct_or_none());
  work_.sensor_rays += direct.rays;
  Columns by_mirror = columns(scene_.sensors.size());
  if (mirrors_.size() > 0)
    work_.sensor_rays += mirror_sun_.add_light(
        sensor_sampler_, sources.suns, beams,
        {by_mirror, sums.sensor_by_mirror, of_realizations.by_mirror_or_none()});
  const BlockLight light =
      sensor_light(sensor_lines_.pooled, optics_, sources, std::move(direct.irradiance),
                   std::move(by_mirror), sensor_parallel_.pooled, followed);
  store_received(light, sources.suns, first_row, direct.sunlit, tally);
}

void LightSolver::errors_per_instant(const BlockSources& sources, std::size_t first_row,
                                     SunColumns& of_patches, SunColumns& of_sensors,
                                     BatchTally& tally) const {
  InstantSpread patches(hierarchy_.patch_count(), sources.suns.size());
  InstantSpread sensors(scene_.sensors.size(), sources.suns.size());
  for (std::size_t r = 0; r < of_patches.direct.size(); ++r) {
    const LineSet& lines = lines_.realizations[r];
    const BlockLight light = block_light(
        hierarchy_, lines, optics_, sources,
        {std::move(of_patches.direct[r]), std::move(of_patches.by_mirror[r]),
         of_patches.circumsolar[r], parallel_.of(r)},
        bounces_);
    const auto ledger = block_ledger(lines, optics_, hierarchy_.area(), sources, light);
    std::copy(ledger.begin(), ledger.end(),
              tally.ledger_instants[r].begin() + static_cast<std::ptrdiff_t>(first_row));
    patches.add(light);
    sensors.add(sensor_light(sensor_lines_.realizations[r], optics_, sources,
                             std::move(of_sensors.direct[r]), std::move(of_sensors.by_mirror[r]),
                             sensor_parallel_.of(r), light.followed));
  }
  patches.store(first_row, tally);
  sensors.store(first_row, tally.sensors);
}

void LightSolver::solve_realization(std::size_t r, const TimeSums& sums, BatchTally& tally) const {
  const LineSet& lines = lines_.realizations[r];
  const auto [sky, base, ground] = first_exposure(
      lines, optics_, sums, sums.sky_of_lines, sums.direct[r], sums.by_mirror[r],
      sums.circumsolar[r], parallel_.of(r));
  const auto reflected = reflect(hierarchy_, lines, optics_, base, ground, bounces_);

  Ledger& ledger = tally.ledger_realization[r];
  for (std::size_t i = 0; i < hierarchy_.patch_count(); ++i) {
    const double total = base[i] + reflected.irradiance[i];
    tally.exposure_realization[r][i] = total;
    ledger += booked({hierarchy_.area()[i], static_cast<double>(optics_.diffuse[i]),
                      optics_.absorbed(i), static_cast<double>(optics_.passed[i]),
                      static_cast<double>(optics_.emission[i]) * sums.length_s, sums.direct[r][i],
                      sky[i], sums.ground, total, reflected.followed[i]},
                     lines.ends[i]);
  }
  ledger += booked(lines.first_light, [&](std::size_t c) { return sums.sky[c]; }, sums.ground);
  ledger += sums.sent_on[r];
  if (!parallel_.ledger.empty()) ledger += scaled(parallel_.ledger[r], sums.length_s);

  const LineSet& from_sensors = sensor_lines_.realizations[r];
  const auto at_sensors = first_exposure(from_sensors, optics_, sums, sums.sky, sums.sensor_direct[r],
                                         sums.sensor_by_mirror[r], {}, sensor_parallel_.of(r));
  auto& received = tally.sensors.exposure_realization[r];
  gather(from_sensors.patches, reflected.followed, received, Into::replace);
  for (std::size_t s = 0; s < received.size(); ++s)
    received[s] += at_sensors.base[s] + at_sensors.ground[s];
}

void LightSolver::make_room(ReceiverTally& tally, std::size_t receivers, std::size_t rows) const {
  for (std::size_t p = 0; p < part_count; ++p) {
    if (!has_part(static_cast<Part>(p))) continue;
    tally.irradiance[p].assign(rows * receivers, 0);
    tally.exposure[p].assign(receivers, 0);
  }
  tally.exposure_realization.assign(static_cast<std::size_t>(rules_.realizations),
                                    std::vector<double>(receivers, 0));
  tally.sunlit_s.assign(receivers, 0);
  tally.irradiance_max.assign(receivers, 0);
  if (rules_.errors == Errors::instants) tally.irradiance_se.assign(rows * receivers, 0);
}

BatchTally LightSolver::empty_tally(std::span<const SunLight> batch) const {
  const std::size_t patches = hierarchy_.patch_count(), rows = batch.size();
  const auto realizations = static_cast<std::size_t>(rules_.realizations);
  BatchTally tally;
  tally.intervals = rows;
  make_room(tally, patches, rows);
  make_room(tally.sensors, scene_.sensors.size(), rows);
  tally.outgoing.assign(patches, 0);
  tally.ledger.resize(rows);
  tally.ledger_realization.resize(realizations);
  if (rules_.errors == Errors::instants)
    tally.ledger_instants.assign(realizations, std::vector<Ledger>(rows));
  return tally;
}

}  // namespace sunload
