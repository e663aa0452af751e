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

/// The sun's irradiance of each realization, straight and by mirrors; empty where neither errors
/// per instant nor bands are asked for.
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

/// What a block of suns brings to patches and sensors by rays.
struct LightSolver::TracedLight {
  DirectSun direct = {}, on_sensors = {};
  CircumsolarLight circumsolar = {};
  Columns by_mirror = {}, on_sensors_by_mirror = {};
  SunColumns of_patches, of_sensors;
  std::vector<MirroredSun> sent_on = {};  ///< [R] by mirrors and gloss, where the scene has any
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
      glossy_sun_(scene, hierarchy_, caster_, sampler_, optics_, lines_, line_rules(rules)),
      bounces_(bounces_of_bands(hierarchy_, lines_.pooled, optics_of_band_, rules)) {
  SUNLOAD_EXPECT(!is_rgb() || rules.transport == Transport::gather, "bands are gathered");
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
  SUNLOAD_EXPECT(!is_rgb(), "light of one band");
  return std::move(solve_bands(batch, watch).front());
}

LightSolver::TimeSums LightSolver::empty_sums() const {
  const auto realizations = static_cast<std::size_t>(rules_.realizations);
  TimeSums sums;
  sums.direct.assign(realizations, std::vector<double>(hierarchy_.patch_count(), 0));
  sums.by_mirror = sums.circumsolar = sums.direct;
  sums.sensor_direct.assign(realizations, std::vector<double>(scene_.sensors.size(), 0));
  sums.sensor_by_mirror = sums.sensor_direct;
  sums.sky.assign(static_cast<std::size_t>(grid_.cell_count()), 0);
  sums.sky_of_lines = sums.sky;
  sums.sent_on.resize(realizations);
  return sums;
}

std::vector<BatchTally> LightSolver::solve_bands(std::span<const SunLight> batch, Watch& watch) {
  const std::size_t bands = optics_of_band_.size();
  const auto realizations = static_cast<std::size_t>(rules_.realizations);
  std::vector<BatchTally> tallies;
  std::vector<TimeSums> sums;
  for (std::size_t b = 0; b < bands; ++b) {
    tallies.push_back(empty_tally(batch));
    sums.push_back(empty_sums());
  }

  // Consecutive intervals with light, up to one block at a time.
  const auto lit = [&](std::size_t k) { return optics_.any_emission || !batch[k].is_dark(); };
  for (std::size_t begin = 0; begin < batch.size();) {
    std::size_t end = begin;
    while (end < batch.size() && end - begin < block_width && lit(end)) ++end;
    const auto block = batch.subspan(begin, end - begin);
    if (!block.empty() && shooter_) shoot_block(block, begin, tallies.front());
    if (!block.empty() && !shooter_) solve_block(block, begin, sums, tallies);
    begin = std::max(end, begin + 1);
    watch.advance(Stage::light, static_cast<double>(begin) / static_cast<double>(batch.size()));
  }

  for (auto& tally : tallies)
    for (std::size_t k = 0; k < batch.size(); ++k)
      tally.energy += scaled(tally.ledger[k], batch[k].length_s);

  if (shooter_) return tallies;  // its realizations have their totals from their series
  const Stopwatch time(work_.realizations_s);
  for (std::size_t b = 0; b < bands; ++b) {
    for (std::size_t r = 0; r < realizations; ++r) {
      solve_realization(optics_of_band_[b], r, sums[b], tallies[b]);
      for (std::size_t i = 0; i < hierarchy_.patch_count(); ++i)
        sums[b].direct[r][i] += sums[b].by_mirror[r][i] + sums[b].circumsolar[r][i];
    }
    tallies[b].sun_realization = std::move(sums[b].direct);
  }
  return tallies;
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
    solve_traced(b, sources_in_band(sources, suns, factors), in_band(traced, factors), first_row,
                 sums[b], tallies[b]);
  }
}

LightSolver::TracedLight LightSolver::trace_block(const BlockSources& sources, TimeSums& sums) {
  const auto& block = sources.suns;
  const std::size_t patches = hierarchy_.patch_count();
  const auto realizations = static_cast<std::size_t>(rules_.realizations);
  const bool of_instants = rules_.errors == Errors::instants;
  const std::size_t columns_of = of_instants || is_rgb() ? realizations : 0;
  TracedLight traced{.of_patches = {columns_of, patches},
                     .of_sensors = {columns_of, scene_.sensors.size()}};
  // Bands ask for time sums alone, to which nothing comes by mirrors that are not there.
  if (!of_instants && mirrors_.size() == 0 && !optics_.any_glossy)
    traced.of_patches.by_mirror.clear();
  {
    const Stopwatch time(work_.direct_s);
    traced.direct =
        direct_sun(caster_, sampler_, block, sums.direct, traced.of_patches.direct_or_none());
    traced.circumsolar = circumsolar_light(hierarchy_, caster_, sampler_, block,
                                           sources.circumsolar, traced.direct.sunlit,
                                           sums.circumsolar,
                                           traced.of_patches.circumsolar_or_none());
    work_.direct_rays += traced.direct.rays + traced.circumsolar.rays;
  }
  traced.by_mirror = columns(patches);
  const MirroredIrradiance into{traced.by_mirror, sums.by_mirror,
                                traced.of_patches.by_mirror_or_none()};
  std::vector<SunBeams> beams;
  if (mirrors_.size() > 0) {
    const Stopwatch time(work_.mirror_s);
    beams = beams_of(block);
    work_.mirror_rays += mirror_sun_.add_light(sampler_, block, beams, into);
    auto followed = mirror_chains_.follow(block, beams, into);
    work_.mirror_rays += followed.rays;
    work_.mirror_shots += followed.shots;
    for (const auto& of_sun : beams) work_.mirror_beams += of_sun.size();
    traced.sent_on = std::move(followed.fates);
  }
  if (optics_.any_glossy) {
    const Stopwatch time(work_.mirror_s);
    work_.mirror_rays += glossy_sun_.add_light(block, into);
    traced.sent_on.resize(realizations);
    glossy_sun_.follow_light(block, traced.sent_on);
  }
  if (!scene_.sensors.empty()) trace_sensors(sources, beams, sums, traced);
  return traced;
}

void LightSolver::trace_sensors(const BlockSources& sources, std::span<const SunBeams> beams,
                                TimeSums& sums, TracedLight& traced) {
  const Stopwatch time(work_.sensors_s);
  traced.on_sensors = direct_sun(caster_, sensor_sampler_, sources.suns, sums.sensor_direct,
                                 traced.of_sensors.direct_or_none());
  work_.sensor_rays += traced.on_sensors.rays;
  traced.on_sensors_by_mirror = columns(scene_.sensors.size());
  if (mirrors_.size() > 0)
    work_.sensor_rays +=
        mirror_sun_.add_light(sensor_sampler_, sources.suns, beams,
                              {traced.on_sensors_by_mirror, sums.sensor_by_mirror,
                               traced.of_sensors.by_mirror_or_none()});
}

void LightSolver::add_exposures(const TracedLight& traced, const BandFactors& factors,
                                std::span<const SunLight> suns, TimeSums& sums) {
  std::array<double, block_width> sun_s{}, sky_s{};
  for (std::size_t k = 0; k < suns.size(); ++k) {
    sun_s[k] = factors.sun[k] * suns[k].length_s;
    sky_s[k] = factors.circumsolar[k] * suns[k].length_s;
  }
  add_weighted(traced.of_patches.direct, sun_s, sums.direct);
  add_weighted(traced.of_patches.by_mirror, sun_s, sums.by_mirror);
  add_weighted(traced.of_patches.circumsolar, sky_s, sums.circumsolar);
  add_weighted(traced.of_sensors.direct, sun_s, sums.sensor_direct);
  add_weighted(traced.of_sensors.by_mirror, sun_s, sums.sensor_by_mirror);
}

/// All of it is proportional to the sun, or to the circumsolar sky.
LightSolver::TracedLight LightSolver::in_band(const TracedLight& traced,
                                              const BandFactors& factors) const {
  const auto each_scaled = [](std::vector<Columns>& all,
                              const std::array<double, block_width>& by) {
    for (auto& one : all) one = scaled(std::move(one), by);
  };
  TracedLight light{.direct = traced.direct,
                    .on_sensors = traced.on_sensors,
                    .circumsolar = traced.circumsolar,
                    .by_mirror = scaled(traced.by_mirror, factors.sun),
                    .on_sensors_by_mirror = scaled(traced.on_sensors_by_mirror, factors.sun),
                    .of_patches = {0, 0},
                    .of_sensors = {0, 0},
                    .sent_on = traced.sent_on};
  light.direct.irradiance = scaled(std::move(light.direct.irradiance), factors.sun);
  light.circumsolar.irradiance =
      scaled(std::move(light.circumsolar.irradiance), factors.circumsolar);
  light.on_sensors.irradiance = scaled(std::move(light.on_sensors.irradiance), factors.sun);
  if (rules_.errors == Errors::instants) {
    light.of_patches = traced.of_patches;
    light.of_sensors = traced.of_sensors;
  }
  for (SunColumns* of : {&light.of_patches, &light.of_sensors}) {
    each_scaled(of->direct, factors.sun);
    each_scaled(of->by_mirror, factors.sun);
    each_scaled(of->circumsolar, factors.circumsolar);
  }
  for (auto& of_realization : light.sent_on)
    MirroredSun::for_each(of_realization, [&](std::vector<double>& of_sun) {
      for (std::size_t k = 0; k < of_sun.size(); ++k) of_sun[k] *= factors.sun[k];
    });
  return light;
}

void LightSolver::solve_traced(std::size_t band, const BlockSources& sources, TracedLight traced,
                               std::size_t first_row, TimeSums& sums, BatchTally& tally) {
  const auto& block = sources.suns;
  const PatchOptics& optics = optics_of_band_[band];
  const auto realizations = static_cast<std::size_t>(rules_.realizations);
  Columns followed;
  {
    const Stopwatch time(work_.solve_s);
    BlockLight light = block_light(hierarchy_, lines_.pooled, optics, sources,
                                   {std::move(traced.direct.irradiance),
                                    std::move(traced.by_mirror), traced.circumsolar.irradiance,
                                    parallel_.pooled},
                                   bounces_);
    const auto ledger = block_ledger(lines_.pooled, optics, hierarchy_.area(), sources, light);
    std::copy(ledger.begin(), ledger.end(),
              tally.ledger.begin() + static_cast<std::ptrdiff_t>(first_row));
    store(optics, light, block, first_row, traced.direct.sunlit, tally);
    followed = std::move(light.followed);
  }
  if (!scene_.sensors.empty()) {
    const Stopwatch time(work_.sensors_s);
    const BlockLight light = sensor_light(
        sensor_lines_.pooled, optics, sources, std::move(traced.on_sensors.irradiance),
        std::move(traced.on_sensors_by_mirror), sensor_parallel_.pooled, followed);
    store_received(light, block, first_row, traced.on_sensors.sunlit, tally.sensors);
  }
  book_sun_sent_on(traced, block, first_row, sums, tally);
  for (std::size_t r = 0; r < parallel_.ledger.size(); ++r)
    for (std::size_t k = 0; k < block.size(); ++k)
      tally.ledger[first_row + k] +=
          scaled(parallel_.ledger[r], 1.0 / static_cast<double>(realizations));
  for (std::size_t k = 0; k < block.size(); ++k) {
    const SunLight& sun = block[k];
    for (std::size_t c = 0; c < sun.sky.size(); ++c) {
      sums.sky[c] += pi * sun.sky[c] * sun.length_s;
      sums.sky_of_lines[c] += pi * (sun.sky[c] - sources.circumsolar_radiance(k, c)) * sun.length_s;
    }
    sums.ground += sun.ground_exitance * sun.length_s;
    sums.length_s += sun.length_s;
  }
  if (rules_.errors == Errors::instants)
    errors_per_instant(optics, sources, first_row, traced, tally);
}

void LightSolver::book_sun_sent_on(const TracedLight& traced, std::span<const SunLight> block,
                                   std::size_t first_row, TimeSums& sums,
                                   BatchTally& tally) const {
  for (std::size_t r = 0; r < traced.sent_on.size(); ++r)
    for (std::size_t k = 0; k < block.size(); ++k) {
      const Ledger fate = sun_sent_on(traced.sent_on[r], k);
      tally.ledger[first_row + k] += scaled(fate, 1.0 / static_cast<double>(rules_.realizations));
      sums.sent_on[r] += scaled(fate, block[k].length_s);
    }
}

std::vector<SunBeams> LightSolver::beams_of(std::span<const SunLight> block) const {
  const BeamRules rules{rules_.mirror_depth, rules_.faint_glint, rules_.most_sun_beams,
                        caster_.offset_m()};
  std::vector<SunBeams> beams(block.size(), SunBeams(mirrors_));
  parallel_for(block.size(), [&](std::size_t k) { beams[k] = SunBeams(mirrors_, block[k], rules); });
  return beams;
}

void LightSolver::store(const PatchOptics& optics, const BlockLight& light,
                        std::span<const SunLight> block, std::size_t first_row,
                        const Columns& sunlit, BatchTally& tally) const {
  store_received(light, block, first_row, sunlit, tally);
  parallel_for(hierarchy_.patch_count(), [&](std::size_t i) {
    for (std::size_t k = 0; k < block.size(); ++k)
      tally.outgoing[i] +=
          static_cast<double>(optics.diffuse[i] * light.total(i, k) + optics.emission[i]) *
          block[k].length_s;
  }, patches_per_task);
}

void LightSolver::errors_per_instant(const PatchOptics& optics, const BlockSources& sources,
                                     std::size_t first_row, TracedLight& traced,
                                     BatchTally& tally) const {
  const std::size_t suns = sources.suns.size();
  SunColumns &of_patches = traced.of_patches, &of_sensors = traced.of_sensors;
  InstantSpread patches(hierarchy_.patch_count(), suns);
  InstantSpread sensors(scene_.sensors.size(), suns);
  for (std::size_t r = 0; r < of_patches.direct.size(); ++r) {
    const LineSet& lines = lines_.realizations[r];
    const BlockLight light = block_light(
        hierarchy_, lines, optics, sources,
        {std::move(of_patches.direct[r]), std::move(of_patches.by_mirror[r]),
         of_patches.circumsolar[r], parallel_.of(r)},
        bounces_);
    const auto ledger = block_ledger(lines, optics, hierarchy_.area(), sources, light);
    std::copy(ledger.begin(), ledger.end(),
              tally.ledger_instants[r].begin() + static_cast<std::ptrdiff_t>(first_row));
    patches.add(light);
    sensors.add(sensor_light(sensor_lines_.realizations[r], optics, sources,
                             std::move(of_sensors.direct[r]), std::move(of_sensors.by_mirror[r]),
                             sensor_parallel_.of(r), light.followed));
  }
  patches.store(first_row, tally);
  sensors.store(first_row, tally.sensors);
  for (std::size_t r = 0; r < traced.sent_on.size(); ++r)
    for (std::size_t k = 0; k < suns; ++k)
      tally.ledger_instants[r][first_row + k] += sun_sent_on(traced.sent_on[r], k);
  for (std::size_t r = 0; r < parallel_.ledger.size(); ++r)
    for (std::size_t k = 0; k < suns; ++k)
      tally.ledger_instants[r][first_row + k] += parallel_.ledger[r];
}

void LightSolver::solve_realization(const PatchOptics& optics, std::size_t r,
                                    const TimeSums& sums, BatchTally& tally) const {
  const LineSet& lines = lines_.realizations[r];
  const auto [sky, base, ground] = first_exposure(
      lines, optics, sums, sums.sky_of_lines, sums.direct[r], sums.by_mirror[r],
      sums.circumsolar[r], parallel_.of(r));
  const auto reflected = reflect(hierarchy_, lines, optics, base, ground, bounces_);

  Ledger& ledger = tally.ledger_realization[r];
  for (std::size_t i = 0; i < hierarchy_.patch_count(); ++i) {
    const double total = base[i] + reflected.irradiance[i];
    tally.exposure_realization[r][i] = total;
    ledger += booked({hierarchy_.area()[i], static_cast<double>(optics.diffuse[i]),
                      optics.absorbed(i), static_cast<double>(optics.passed[i]),
                      static_cast<double>(optics.emission[i]) * sums.length_s, sums.direct[r][i],
                      sky[i], sums.ground, total, reflected.followed[i]},
                     lines.ends[i]);
  }
  ledger += booked(lines.first_light, [&](std::size_t c) { return sums.sky[c]; }, sums.ground);
  ledger += sums.sent_on[r];
  if (!parallel_.ledger.empty()) ledger += scaled(parallel_.ledger[r], sums.length_s);

  const LineSet& from_sensors = sensor_lines_.realizations[r];
  const auto at_sensors = first_exposure(from_sensors, optics, sums, sums.sky, sums.sensor_direct[r],
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
