// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/transport/shooting.h"

#include <algorithm>

#include "solver/base/chunks.h"
#include "solver/base/stopwatch.h"
#include "solver/base/threads.h"
#include "solver/gather/block_tally.h"
#include "solver/gather/sensor_light.h"
#include "solver/light/instant_spread.h"
#include "solver/traced/light_iteration.h"

namespace sunload {

namespace {

/// Mean over realizations, of patches or sensors.
class MeanLight {
 public:
  MeanLight(std::size_t receivers, std::size_t realizations)
      : of_one_(1.0 / static_cast<double>(realizations)), lamps_(receivers, 0) {
    for (auto& part : parts_) part = double_columns(receivers);
  }
  void add(const ShotLight& light) { add(light, *light.lamps); }
  void add(const BlockLight& light) { add(light, light.lamps); }
  BlockLight in_float() const {
    const auto to_float = [](const DoubleColumns& part) {
      return Columns(part.begin(), part.end());
    };
    BlockLight light;
    light.direct = to_float(parts_[0]);
    light.sky = to_float(parts_[1]);
    light.mirror = to_float(parts_[2]);
    light.reflected = to_float(parts_[3]);
    light.lamps.assign(lamps_.begin(), lamps_.end());
    return light;
  }

 private:
  template <class Light, class Lamps>
  void add(const Light& light, const Lamps& lamps) {
    const std::array from{&light.direct, &light.sky, &light.mirror, &light.reflected};
    parallel_for(
        lamps_.size(),
        [&](std::size_t i) {
          for (std::size_t p = 0; p < from.size(); ++p)
            for (std::size_t k = i * block_width; k < (i + 1) * block_width; ++k)
              parts_[p][k] += of_one_ * static_cast<double>((*from[p])[k]);
          lamps_[i] += of_one_ * static_cast<double>(lamps[i]);
        },
        receivers_per_chunk);
  }

  double of_one_;
  std::array<DoubleColumns, 4> parts_;  ///< direct, sky, mirror, reflected
  std::vector<double> lamps_;
};

/// Adds the time sums of one realization to its exposures, in all, by parts of the light and of
/// the period.
template <class Light, class Lamps>
void add_exposure(const Light& light, const Lamps& lamps, const Block& block, std::size_t r,
                  ReceiverTally& tally) {
  using Times = std::array<double, block_width>;
  Times lengths_s{};
  for (std::size_t k = 0; k < block.suns.size(); ++k) lengths_s[k] = block.suns[k].length_s;
  const auto add_times = [&](std::vector<double>& exposure, const auto& irradiance,
                             const Times& times) {
    parallel_for(
        exposure.size(),
        [&](std::size_t i) {
          for (std::size_t k = 0; k < block.suns.size(); ++k)
            exposure[i] += static_cast<double>(irradiance(i, k)) * times[k];
        },
        receivers_per_chunk);
  };
  const auto add = [&](std::vector<double>* exposure, const auto& irradiance) {
    if (exposure) add_times(*exposure, irradiance, lengths_s);
  };
  const auto of = [](const auto& columns) {
    return [&columns](std::size_t i, std::size_t k) { return columns[i * block_width + k]; };
  };
  const auto part = [&](Part which) { return part_of_realization(tally, which, r); };
  add(&tally.exposure_realization[r], total_of(light));
  add(part(Part::direct), of(light.direct));
  add(part(Part::sky), of(light.sky));
  add(part(Part::mirror), of(light.mirror));
  add(part(Part::lamps), [&](std::size_t i, std::size_t) { return lamps[i]; });
  add(part(Part::reflected), of(light.reflected));
  for (PartTally& period : tally.parts) {
    if (!period.with_errors) continue;
    Times times = lengths_s;
    for (std::size_t k = 0; k < block.suns.size(); ++k) times[k] *= period.share[block.rows[k]];
    add_times(period.exposure_realization[r], total_of(light), times);
  }
}

/// `parallel`: irradiance by parallel sources, or empty.
void add_spread(const ShotLight& light, const std::vector<double>& parallel,
                InstantSpreadBySource& spread) {
  const auto of_parallel = [&](std::size_t i) { return parallel.empty() ? 0 : parallel[i]; };
  spread.add(
      total_of(light),
      [&](std::size_t i, std::size_t k) {
        return light.by_source->sun[i * block_width + k] + of_parallel(i);
      },
      [&](std::size_t i, std::size_t k) {
        return light.by_source->shot[i * block_width + k] + (*light.lamps)[i] - of_parallel(i);
      });
}

/// What came by which samples, for pilots. `parallel`: irradiance by parallel sources, or empty.
void add_by_source(std::size_t r, const ShotLight& light, const std::vector<double>& parallel,
                   std::span<const IntervalLight> block, ExposureBySource& to) {
  parallel_for(
      light.lamps->size(),
      [&](std::size_t i) {
        const double of_parallel = parallel.empty() ? 0 : parallel[i];
        for (std::size_t k = 0; k < block.size(); ++k) {
          const double s = block[k].length_s;
          const std::size_t at = i * block_width + k;
          to.sun[r][i] += s * light.by_source->sun[at];
          to.parallel[r][i] += s * of_parallel;
          to.emitted[r][i] += s * ((*light.lamps)[i] - of_parallel);
          to.reflected[r][i] += s * light.by_source->shot[at];
        }
      },
      receivers_per_chunk);
}

ShootingRules shooting_rules(const TracedScene& traced) {
  const SolverRules& rules = traced.rules;
  return {.bounces = traced.bounces,
          .jacobi = rules.jacobi,
          .power_per_sample_w = rules.power_per_sample_w,
          .samples_per_patch = rules.samples_per_patch.value_or(rules.lines_per_patch),
          .by_source = rules.by_source};
}

/// Samples that are more than the lines exchange light on a finer level.
LineRules line_rules_of_shots(const SolverRules& rules) {
  LineRules of_shots = line_rules(rules);
  const int samples = std::max(rules.lines_per_patch, rules.samples_per_patch.value_or(0));
  of_shots.largest_link = rules.link_threshold / samples;
  return of_shots;
}

/// One batch.
class ShotBatch : public BatchTransport {
 public:
  ShotBatch(const TracedScene& traced, const Shooter& shooter, BatchTally& tally, WorkDone& work)
      : traced_(traced), shooter_(shooter), tally_(tally), work_(work) {}

  void light(const Block& block) override {
    const BlockSources sources(block.suns, static_cast<std::size_t>(traced_.grid.cell_count()));
    const auto shares = shares_of_patches(traced_, sources, work_);
    const RayLight sun = direct_on_patches(traced_, sources, shares, work_);
    RayLight on_sensors;
    if (traced_.sensors.count() > 0) on_sensors = rays_on_sensors(traced_, sources, shares, work_);
    const FirstMirrored::SentSuns sent = send_sun(block);
    const Stopwatch time(work_[Work::shoot_s]);
    shoot(block, sources, sun, std::move(on_sensors), sent);
  }

  /// Realizations have their totals from their series.
  void finish() override {}

 private:
  void shoot(const Block& block, const BlockSources& sources, const RayLight& sun,
             RayLight of_sensors, const FirstMirrored::SentSuns& sent) {
    const auto realizations = static_cast<std::size_t>(traced_.rules.realizations);
    const std::size_t patches = traced_.patches.count(), sensors = traced_.sensors.count();
    const std::size_t suns = block.suns.size();
    const bool of_instants = traced_.rules.errors == Errors::instants;  // else no spreads
    MeanLight mean(patches, realizations), on_sensors(sensors, realizations);
    InstantSpread spread(of_instants ? patches : 0, suns);
    InstantSpread sensor_spread(of_instants ? sensors : 0, suns);
    InstantSpreadBySource by_source(of_instants && traced_.rules.by_source ? patches : 0, suns);
    for (std::size_t r = 0; r < realizations; ++r) {
      const ShotLight light = shooter_.light(r, sources, sun.of_realizations.direct[r], sent);
      count(light);
      mean.add(light);
      spread.add(total_of(light));
      if (light.by_source) add_spread(light, traced_.patches.lamps.of(r), by_source);
      add_realization(r, light, block);
      if (sensors == 0) continue;
      const BlockLight received = shot_to_sensors(r, sources, light, of_sensors.of_realizations);
      on_sensors.add(received);
      sensor_spread.add(total_of(received));
      add_exposure(received, received.lamps, block, r, tally_.sensors);
    }
    store_patches(traced_.optics, mean.in_float(), block.suns, block.rows, sun.sunlit, tally_);
    if (sensors > 0)
      store_received(on_sensors.in_float(), block.suns, block.rows, of_sensors.sunlit,
                     tally_.sensors);
    spread.store(block.rows, tally_.irradiance_se);
    sensor_spread.store(block.rows, tally_.sensors.irradiance_se);
    by_source.store(block.rows, tally_.se_by_source);
  }

  FirstMirrored::SentSuns send_sun(const Block& block) {
    const Stopwatch time(work_[Work::mirror_s]);
    auto sent = shooter_.send_sun(block.suns);
    work_.add(Work::mirror_rays, sent.rays);
    return sent;
  }

  void count(const ShotLight& light) {
    work_.add(Work::samples, light.samples);
    work_.add(Work::shot_rays, light.rays);
    work_[Work::wanted_samples] += light.wanted;
  }

  /// Sensors gather what patches have shot, or would if all of their light were followed.
  BlockLight shot_to_sensors(std::size_t r, const BlockSources& sources, const ShotLight& light,
                             SunColumns& rays) const {
    return sensor_light(traced_.sensors.lines.realizations[r], traced_.optics, sources,
                        {std::move(rays.direct[r]), std::move(rays.mirror[r]), {}},
                        traced_.sensors.lamps.of(r), seen_radiosity(light));
  }

  Columns seen_radiosity(const ShotLight& light) const {
    if (light.estimated.empty()) return {light.shot_radiosity.begin(), light.shot_radiosity.end()};
    return reflected_radiosity(traced_.optics, light, traced_.patches.count());
  }

  void add_realization(std::size_t r, const ShotLight& light, const Block& block) {
    add_exposure(light, *light.lamps, block, r, tally_);
    if (light.by_source)
      add_by_source(r, light, traced_.patches.lamps.of(r), block.suns, tally_.by_source);
    for (std::size_t k = 0; k < block.suns.size(); ++k) {
      const Ledger& ledger = light.ledger[k];
      tally_.ledger[block.rows[k]] +=
          scaled(ledger, 1.0 / static_cast<double>(tally_.exposure_realization.size()));
      tally_.ledger_realization[r] += scaled(ledger, block.suns[k].length_s);
      if (traced_.rules.errors == Errors::instants)
        tally_.ledger_instants[r][block.rows[k]] = ledger;
    }
  }

  const TracedScene& traced_;
  const Shooter& shooter_;
  BatchTally& tally_;
  WorkDone& work_;
};

}  // namespace

Shooting::Shooting(const TracedScene& traced)
    : LightTransport(traced), shooter_([&] {
        const Stopwatch time(work_[Work::shoot_s]);
        return Shooter(traced.scene, traced.hierarchy(), traced.caster, traced.patches.sampler,
                       traced.grid, traced.optics, traced.patches.lines, traced.patches.lamps,
                       traced.beyond_of_band.front(), line_rules_of_shots(traced.rules),
                       shooting_rules(traced));
      }()) {
  work_.add(Work::shot_rays, shooter_.rays());
  work_.add(Work::samples, shooter_.samples());
  work_[Work::wanted_samples] = shooter_.wanted();
}

std::unique_ptr<BatchTransport> Shooting::begin(std::vector<BatchTally>& tallies, WorkDone& work,
                                                RayRecord* /*none*/) const {
  return std::make_unique<ShotBatch>(traced_, shooter_, tallies.front(), work);
}

}  // namespace sunload
