// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/solver.h"

#include <algorithm>

#include "geo/base/check.h"
#include "solver/base/stopwatch.h"
#include "solver/gather/block_tally.h"
#include "solver/gather/guide.h"
#include "solver/gather/sensor_light.h"
#include "solver/gather/time_sums.h"
#include "solver/gather/traced_light.h"
#include "solver/light/instant_spread.h"
#include "solver/shoot/shooting.h"

namespace sunload {

namespace {

LineRules line_rules(const SolverRules& rules) {
  return {
      rules.lines_per_patch, rules.lines_of_patch, rules.realizations,
      rules.mirror_depth,    rules.seed,           rules.link_threshold / rules.lines_per_patch};
}

ShootingRules shooting_rules(const SolverRules& rules, int bounces) {
  return {bounces, rules.jacobi, rules.power_per_sample_w,
          rules.samples_per_patch.value_or(rules.lines_per_patch), rules.by_source};
}

/// Samples that are more than the lines exchange light on a finer level.
LineRules line_rules_of_shots(const SolverRules& rules) {
  LineRules of_shots = line_rules(rules);
  const int samples = std::max(rules.lines_per_patch, rules.samples_per_patch.value_or(0));
  of_shots.largest_link = rules.link_threshold / samples;
  return of_shots;
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
  Guide guide;
  if (!scene.sensors.empty()) guide = emitting_surfaces(scene, hierarchy, optics);
  Lines lines = trace_sensor_lines(scene, hierarchy, caster, grid, guide, line_rules(rules));
  work.sensor_rays = lines.rays;
  return lines;
}

std::vector<PatchOptics> optics_of_bands(const Scene& scene, const Hierarchy& hierarchy,
                                         const PatchOptics& broadband, Bands bands) {
  if (bands == Bands::broadband) return {broadband};
  std::vector<PatchOptics> optics;
  for (std::size_t b = 0; b < band_count; ++b) optics.push_back(patch_optics(scene, hierarchy, b));
  return optics;
}

/// As many as the brightest band needs.
int bounces_of_bands(const Hierarchy& mesh, const LineSet& lines,
                     const std::vector<PatchOptics>& optics, const SolverRules& rules) {
  int bounces = 0;
  for (const auto& of_band : optics)
    bounces = std::max(bounces, bounces_needed(mesh, lines, of_band, rules.bounces, rules.unshot));
  return bounces;
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
      optics_of_band_(optics_of_bands(scene, hierarchy_, optics_, rules.bands)),
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
      glossy_sun_(scene, hierarchy_, caster_, sampler_, optics_, line_rules(rules)),
      lobe_images_(scene, caster_, sensor_sampler_, line_rules(rules)),
      bounces_(bounces_of_bands(hierarchy_, lines_.pooled, optics_of_band_, rules)) {
  SUNLOAD_EXPECT(!is_rgb() || rules.transport == Transport::gather, "bands are gathered");
  work_.direct_rays += parallel_.rays;
  if (rules.transport != Transport::shoot) return;
  const Stopwatch time(work_.shoot_s);
  shooter_ = std::make_unique<Shooter>(scene, hierarchy_, caster_, sampler_, grid_, optics_, lines_,
                                       parallel_, line_rules_of_shots(rules),
                                       shooting_rules(rules, bounces_));
  work_.shot_rays = shooter_->rays();
  work_.samples = shooter_->samples();
  work_.wanted_samples = shooter_->wanted();
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
  SUNLOAD_EXPECT(!is_rgb(), "light of one band");
  return std::move(solve_bands(batch, watch).front());
}

BatchTally LightSolver::empty_tally(std::size_t intervals) const {
  TallyShape shape{hierarchy_.patch_count(),
                   scene_.sensors.size(),
                   intervals,
                   static_cast<std::size_t>(rules_.realizations),
                   {},
                   rules_.errors,
                   rules_.by_source,
                   rules_.transport};
  for (std::size_t p = 0; p < part_count; ++p) shape.parts[p] = has_part(static_cast<Part>(p));
  return sunload::empty_tally(shape);
}

TimeSums LightSolver::empty_sums() const {
  TimeSums sums(static_cast<std::size_t>(rules_.realizations), hierarchy_.patch_count(),
                scene_.sensors.size(), static_cast<std::size_t>(grid_.cell_count()));
  if (optics_.any_glossy) sums.by_gloss = sums.by_mirror;
  return sums;
}

std::vector<BatchTally> LightSolver::solve_bands(std::span<const SunLight> batch, Watch& watch) {
  std::vector<BatchTally> tallies;
  std::vector<TimeSums> sums;
  for (std::size_t b = 0; b < optics_of_band_.size(); ++b) {
    tallies.push_back(empty_tally(batch.size()));
    sums.push_back(empty_sums());
  }
  for (std::size_t begin = 0; begin < batch.size();) {
    const auto block = lit_block(batch.subspan(begin));
    if (!block.empty() && shooter_) shoot_block(block, begin, tallies.front());
    if (!block.empty() && !shooter_) solve_block(block, begin, sums, tallies);
    begin += std::max(block.size(), std::size_t{1});
    watch.advance(Stage::light, static_cast<double>(begin) / static_cast<double>(batch.size()));
  }
  for (auto& tally : tallies)
    for (std::size_t k = 0; k < batch.size(); ++k)
      tally.energy += scaled(tally.ledger[k], batch[k].length_s);
  // When shooting, realizations have their totals from their series.
  if (!shooter_) solve_realizations(sums, tallies);
  return tallies;
}

/// The consecutive intervals with light that `batch` begins with, up to one block.
std::span<const SunLight> LightSolver::lit_block(std::span<const SunLight> batch) const {
  std::size_t suns = 0;
  while (suns < std::min(batch.size(), block_width) &&
         (optics_.any_emission || !batch[suns].is_dark()))
    ++suns;
  return batch.first(suns);
}

void LightSolver::solve_block(std::span<const SunLight> block, std::size_t first_row,
                              std::vector<TimeSums>& sums, std::vector<BatchTally>& tallies) {
  BlockSources sources(block, static_cast<std::size_t>(grid_.cell_count()));
  sources.split_sky(grid_);
  if (!is_rgb())
    return solve_traced(0, sources, trace_block(sources, sums.front()), first_row, sums.front(),
                        tallies.front());
  TimeSums of_broadband = empty_sums();
  const TracedLight traced = trace_block(sources, of_broadband);
  for (std::size_t b = 0; b < sums.size(); ++b) {
    const auto suns = suns_in_band(block, b);
    const BandFactors factors = band_factors(sources, suns);
    add_exposures(traced, factors, suns, sums[b]);
    solve_traced(b, sources_in_band(sources, suns, factors),
                 in_band(traced, factors, rules_.errors), first_row, sums[b], tallies[b]);
  }
}

void LightSolver::solve_traced(std::size_t band, const BlockSources& sources, TracedLight traced,
                               std::size_t first_row, TimeSums& sums, BatchTally& tally) {
  const PatchOptics& optics = optics_of_band_[band];
  const Columns followed = light_patches(optics, sources, first_row, traced, tally);
  if (!scene_.sensors.empty())
    light_sensors(optics, sources, followed, first_row, traced, tally.sensors);
  book_sun_sent_on(traced, sources.suns, first_row, sums, tally);
  book_parallel(sources.suns.size(), first_row, tally);
  sums.add_sources(sources);
  if (rules_.errors == Errors::instants)
    errors_per_instant(optics, sources, first_row, traced, tally);
}

Columns LightSolver::light_patches(const PatchOptics& optics, const BlockSources& sources,
                                   std::size_t first_row, TracedLight& traced, BatchTally& tally) {
  const Stopwatch time(work_.solve_s);
  BlockLight light = block_light(hierarchy_, lines_.pooled, optics, sources,
                                 {std::move(traced.direct.irradiance), std::move(traced.by_mirror),
                                  traced.circumsolar.irradiance, parallel_.pooled},
                                 bounces_);
  const auto ledger = block_ledger(lines_.pooled, optics, hierarchy_.area(), sources, light);
  std::copy(ledger.begin(), ledger.end(),
            tally.ledger.begin() + static_cast<std::ptrdiff_t>(first_row));
  store_patches(optics, light, sources.suns, first_row, traced.direct.sunlit, tally);
  return std::move(light.followed);
}

void LightSolver::light_sensors(const PatchOptics& optics, const BlockSources& sources,
                                const Columns& followed, std::size_t first_row, TracedLight& traced,
                                ReceiverTally& tally) {
  const Stopwatch time(work_.sensors_s);
  const BlockLight light =
      sensor_light(sensor_lines_.pooled, optics, sources, std::move(traced.on_sensors.irradiance),
                   std::move(traced.on_sensors_by_mirror), sensor_parallel_.pooled, followed);
  store_received(light, sources.suns, first_row, traced.on_sensors.sunlit, tally);
}

void LightSolver::book_sun_sent_on(const TracedLight& traced, std::span<const SunLight> block,
                                   std::size_t first_row, TimeSums& sums, BatchTally& tally) const {
  for (std::size_t r = 0; r < traced.sent_on.size(); ++r)
    for (std::size_t k = 0; k < block.size(); ++k) {
      const Ledger fate = booked(traced.sent_on[r][k]);
      tally.ledger[first_row + k] += scaled(fate, 1.0 / static_cast<double>(rules_.realizations));
      sums.sent_on[r] += scaled(fate, block[k].length_s);
    }
}

void LightSolver::book_parallel(std::size_t suns, std::size_t first_row, BatchTally& tally) const {
  for (const Ledger& of_realization : parallel_.ledger)
    for (std::size_t k = 0; k < suns; ++k)
      tally.ledger[first_row + k] +=
          scaled(of_realization, 1.0 / static_cast<double>(rules_.realizations));
}

void LightSolver::errors_per_instant(const PatchOptics& optics, const BlockSources& sources,
                                     std::size_t first_row, TracedLight& traced,
                                     BatchTally& tally) const {
  const std::size_t suns = sources.suns.size();
  SunColumns &of_patches = traced.of_patches, &of_sensors = traced.of_sensors;
  InstantSpread patches(hierarchy_.patch_count(), suns);
  InstantSpread sensors(scene_.sensors.size(), suns);
  InstantSpreadBySource by_source(rules_.by_source ? hierarchy_.patch_count() : 0, suns);
  for (std::size_t r = 0; r < of_patches.direct.size(); ++r) {
    const LineSet& lines = lines_.realizations[r];
    const std::vector<double>& parallel = parallel_.of(r);
    const BlockLight light =
        block_light(hierarchy_, lines, optics, sources,
                    {std::move(of_patches.direct[r]), std::move(of_patches.by_mirror[r]),
                     of_patches.circumsolar[r], parallel},
                    bounces_);
    const auto ledger = block_ledger(lines, optics, hierarchy_.area(), sources, light);
    std::copy(ledger.begin(), ledger.end(),
              tally.ledger_instants[r].begin() + static_cast<std::ptrdiff_t>(first_row));
    const BlockLight on_sensors = sensor_light(
        sensor_lines_.realizations[r], optics, sources, std::move(of_sensors.direct[r]),
        std::move(of_sensors.by_mirror[r]), sensor_parallel_.of(r), light.followed);
    patches.add(total_of(light));
    sensors.add(total_of(on_sensors));
    by_source.add(
        total_of(light),
        [&](std::size_t i, std::size_t k) {
          return static_cast<double>(traced.by_samples[r][i * block_width + k]) +
                 (parallel.empty() ? 0 : parallel[i]);
        },
        [](std::size_t, std::size_t) { return 0; });
  }
  patches.store(first_row, tally.irradiance_se);
  sensors.store(first_row, tally.sensors.irradiance_se);
  by_source.store(first_row, tally.se_by_source);
  for (std::size_t r = 0; r < traced.sent_on.size(); ++r)
    for (std::size_t k = 0; k < suns; ++k)
      tally.ledger_instants[r][first_row + k] += booked(traced.sent_on[r][k]);
  for (std::size_t r = 0; r < parallel_.ledger.size(); ++r)
    for (std::size_t k = 0; k < suns; ++k)
      tally.ledger_instants[r][first_row + k] += parallel_.ledger[r];
}

void LightSolver::solve_realizations(std::vector<TimeSums>& sums,
                                     std::vector<BatchTally>& tallies) {
  const Stopwatch time(work_.realizations_s);
  for (std::size_t b = 0; b < tallies.size(); ++b) {
    for (std::size_t r = 0; r < sums[b].direct.size(); ++r) {
      std::vector<double> sun = sums[b].direct[r];
      for (std::size_t i = 0; i < sun.size(); ++i) {
        sun[i] += sums[b].by_mirror[r][i] + sums[b].circumsolar[r][i];
        if (!sums[b].by_gloss.empty()) sums[b].by_mirror[r][i] += sums[b].by_gloss[r][i];
      }
      solve_realization(optics_of_band_[b], r, sums[b], tallies[b]);
      tallies[b].by_source.sun.push_back(std::move(sun));
      if (!rules_.by_source) continue;
      std::vector<double> parallel = parallel_.of(r);
      for (double& E : parallel) E *= sums[b].length_s;
      tallies[b].by_source.parallel.push_back(std::move(parallel));
    }
  }
}

void LightSolver::solve_realization(const PatchOptics& optics, std::size_t r, const TimeSums& sums,
                                    BatchTally& tally) const {
  const auto followed = realization_of_patches(optics, r, sums, tally);
  Ledger& ledger = tally.ledger_realization[r];
  ledger += booked(
      lines_.realizations[r].first_light, [&](std::size_t c) { return sums.sky[c]; }, sums.ground);
  ledger += sums.sent_on[r];
  if (!parallel_.ledger.empty()) ledger += scaled(parallel_.ledger[r], sums.length_s);
  realization_of_sensors(optics, r, sums, followed, tally.sensors);
}

std::vector<double> LightSolver::realization_of_patches(const PatchOptics& optics, std::size_t r,
                                                        const TimeSums& sums,
                                                        BatchTally& tally) const {
  const LineSet& lines = lines_.realizations[r];
  const auto [sky, base, ground] =
      first_exposure(lines, optics, sums,
                     {sums.direct[r], sums.by_mirror[r], sums.circumsolar[r], parallel_.of(r)});
  auto reflected = reflect(hierarchy_, lines, optics, base, ground, bounces_);
  for (std::size_t i = 0; i < hierarchy_.patch_count(); ++i) {
    const double total = base[i] + reflected.irradiance[i];
    tally.exposure_realization[r][i] = total;
    tally.ledger_realization[r] +=
        booked({hierarchy_.area()[i], static_cast<double>(optics.diffuse[i]), optics.absorbed(i),
                static_cast<double>(optics.passed[i]),
                static_cast<double>(optics.emission[i]) * sums.length_s, sums.direct[r][i], sky[i],
                sums.ground, total, reflected.followed[i]},
               lines.ends[i]);
  }
  return std::move(reflected.followed);
}

void LightSolver::realization_of_sensors(const PatchOptics& optics, std::size_t r,
                                         const TimeSums& sums, const std::vector<double>& followed,
                                         ReceiverTally& tally) const {
  const LineSet& lines = sensor_lines_.realizations[r];
  const std::vector<double> whole_sky;  // sensors see all of it by their lines
  const auto [sky, base, ground] = first_exposure(
      lines, optics, sums,
      {sums.sensor_direct[r], sums.sensor_by_mirror[r], whole_sky, sensor_parallel_.of(r)});
  auto& received = tally.exposure_realization[r];
  gather(lines.patches, followed, received, Into::replace);
  for (std::size_t s = 0; s < received.size(); ++s) received[s] += base[s] + ground[s];
}

}  // namespace sunload
