// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A block of suns by shooting: every realization for itself, series and totals from their mean.
#include "solver/base/chunks.h"
#include "solver/base/stopwatch.h"
#include "solver/base/threads.h"
#include "solver/gather/block_tally.h"
#include "solver/gather/sensor_light.h"
#include "solver/gather/traced_light.h"
#include "solver/light/instant_spread.h"
#include "solver/shoot/shooting.h"
#include "solver/solver.h"

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

/// Adds the time sums of one realization to its exposures.
template <class Light>
void add_exposure(const Light& light, std::span<const SunLight> block,
                  std::vector<double>& exposure) {
  parallel_for(
      exposure.size(),
      [&](std::size_t i) {
        for (std::size_t k = 0; k < block.size(); ++k)
          exposure[i] += static_cast<double>(light.total(i, k)) * block[k].length_s;
      },
      receivers_per_chunk);
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

}  // namespace

void LightSolver::shoot_block(std::span<const SunLight> block, std::size_t first_row,
                              BatchTally& tally) {
  const BlockSources sources(block, static_cast<std::size_t>(grid_.cell_count()));
  TracedLight traced = trace_for_shooting(sources);
  const FirstMirrored::SentSuns sent = send_sun(block);
  const Stopwatch time(work_.shoot_s);
  const auto realizations = static_cast<std::size_t>(rules_.realizations);
  const std::size_t patches = hierarchy_.patch_count(), sensors = scene_.sensors.size();
  const bool of_instants = rules_.errors == Errors::instants;  // else spreads have nothing to do
  MeanLight mean(patches, realizations), on_sensors(sensors, realizations);
  InstantSpread spread(of_instants ? patches : 0, block.size()),
      of_sensors(of_instants ? sensors : 0, block.size());
  InstantSpreadBySource by_source(of_instants && rules_.by_source ? patches : 0, block.size());
  for (std::size_t r = 0; r < realizations; ++r) {
    const ShotLight light = shooter_->light(r, sources, traced.of_patches.direct[r], sent);
    work_.samples += light.samples;
    work_.shot_rays += light.rays;
    work_.wanted_samples += light.wanted;
    mean.add(light);
    spread.add(total_of(light));
    if (light.by_source) add_spread(light, parallel_.of(r), by_source);
    add_realization(r, light, block, first_row, tally);
    if (sensors == 0) continue;
    const BlockLight received = shot_to_sensors(r, sources, light, traced.of_sensors);
    on_sensors.add(received);
    of_sensors.add(total_of(received));
    add_exposure(received, block, tally.sensors.exposure_realization[r]);
  }
  store_patches(optics_, mean.in_float(), block, first_row, traced.direct.sunlit, tally);
  if (sensors > 0)
    store_received(on_sensors.in_float(), block, first_row, traced.on_sensors.sunlit,
                   tally.sensors);
  spread.store(first_row, tally.irradiance_se);
  of_sensors.store(first_row, tally.sensors.irradiance_se);
  by_source.store(first_row, tally.se_by_source);
}

/// The direct sun of every realization, and what comes to sensors by mirrors and gloss.
TracedLight LightSolver::trace_for_shooting(const BlockSources& sources) {
  const auto realizations = static_cast<std::size_t>(rules_.realizations);
  const std::size_t patches = hierarchy_.patch_count();
  TracedLight traced;
  traced.of_patches.direct.assign(realizations, columns(patches));
  traced.of_sensors = {realizations, scene_.sensors.size()};
  {
    const Stopwatch time(work_.direct_s);
    // Totals come from the series of each realization, which the sun is part of.
    std::vector<std::vector<double>> unused(realizations, std::vector<double>(patches, 0));
    traced.direct = direct_sun(caster_, sampler_, sources.suns, unused, &traced.of_patches.direct);
    work_.direct_rays += traced.direct.rays;
  }
  if (scene_.sensors.empty()) return traced;
  auto beams = mirrors_.size() > 0 ? beams_of(sources.suns) : std::vector<SunBeams>{};
  TimeSums unused(realizations, 0, scene_.sensors.size(), 0);
  trace_sensors(sources.suns, std::move(beams), unused, traced);
  return traced;
}

/// What came by which samples, for pilots.
void LightSolver::add_by_source(std::size_t r, const ShotLight& light,
                                std::span<const SunLight> block, ExposureBySource& to) const {
  const std::vector<double>& parallel = parallel_.of(r);
  parallel_for(
      hierarchy_.patch_count(),
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

FirstMirrored::SentSuns LightSolver::send_sun(std::span<const SunLight> block) {
  const Stopwatch time(work_.mirror_s);
  auto sent = shooter_->send_sun(block);
  work_.mirror_rays += sent.rays;
  return sent;
}

/// Sensors gather what patches have shot.
BlockLight LightSolver::shot_to_sensors(std::size_t r, const BlockSources& sources,
                                        const ShotLight& light, SunColumns& of_sensors) const {
  return sensor_light(sensor_lines_.realizations[r], optics_, sources,
                      std::move(of_sensors.direct[r]), std::move(of_sensors.by_mirror[r]),
                      sensor_parallel_.of(r),
                      Columns(light.followed.begin(), light.followed.end()));
}

void LightSolver::add_realization(std::size_t r, const ShotLight& light,
                                  std::span<const SunLight> block, std::size_t first_row,
                                  BatchTally& tally) const {
  add_exposure(light, block, tally.exposure_realization[r]);
  if (light.by_source) add_by_source(r, light, block, tally.by_source);
  for (std::size_t k = 0; k < block.size(); ++k) {
    const Ledger& ledger = light.ledger[k];
    tally.ledger[first_row + k] +=
        scaled(ledger, 1.0 / static_cast<double>(tally.exposure_realization.size()));
    tally.ledger_realization[r] += scaled(ledger, block[k].length_s);
    if (rules_.errors == Errors::instants) tally.ledger_instants[r][first_row + k] = ledger;
  }
}

}  // namespace sunload
