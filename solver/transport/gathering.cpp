// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/transport/gathering.h"

#include <algorithm>

#include "solver/base/stopwatch.h"
#include "solver/gather/block_tally.h"
#include "solver/gather/sensor_light.h"
#include "solver/light/instant_spread.h"
#include "solver/transport/band_rays.h"
#include "solver/transport/gathered_sums.h"
#include "solver/transport/part_sums.h"
#include "solver/transport/realizations.h"

namespace sunload {

namespace {

/// One batch.
class GatheredBatch : public BatchTransport {
 public:
  GatheredBatch(const TracedScene& traced, std::vector<BatchTally>& tallies, WorkDone& work,
                RayRecord* record)
      : traced_(traced), tallies_(tallies), work_(work), rays_(traced, SunsSky::by_rays, record) {
    for (std::size_t b = 0; b < tallies.size(); ++b) {
      sums_.push_back(empty_sums(traced));
      part_sums_.emplace_back(traced, b, tallies[b]);
    }
  }

  void light(const Block& block) override {
    BlockSources sources(block.suns, static_cast<std::size_t>(traced_.grid.cell_count()));
    sources.split_sky(traced_.grid);
    if (traced_.is_rgb()) return light_in_bands(block, sources);
    BlockRays rays =
        rays_.next(sources, kept(), part_sums_.front().timed(block, sums_.front()), work_);
    part_sums_.front().add_sources(block, sources);
    light_band(0, block, sources, std::move(rays));
  }

  void finish() override {
    const Stopwatch time(work_[Work::realizations_s]);
    rays_.end(sums_over_time(), work_);
    for (std::size_t b = 0; b < tallies_.size(); ++b) {
      solve_realizations(traced_, b, sums_[b], tallies_[b]);
      part_sums_[b].solve();
    }
  }

 private:
  bool of_instants() const { return traced_.rules.errors == Errors::instants; }
  /// Those that rays are added to as they are traced.
  std::vector<TimeSums*> sums_over_time() {
    if (traced_.is_rgb()) return {};
    return part_sums_.front().all(sums_.front());
  }
  Kept kept() const {
    return {.columns = of_instants() || traced_.is_rgb(),
            .all_parts = of_instants(),
            .by_samples = traced_.rules.by_source};
  }

  /// Rays are traced once, for the mean of the bands.
  void light_in_bands(const Block& block, const BlockSources& sources) {
    const BlockRays rays = rays_.next(sources, kept(), {}, work_);
    for (std::size_t b = 0; b < sums_.size(); ++b) {
      const auto suns = suns_in_band(block.suns, b);
      const BandFactors factors = band_factors(sources, suns, b);
      add_exposures(rays, factors, suns, sums_[b]);
      const Block of_band{suns, block.rows};
      const BlockSources of_band_sources = sources_in_band(sources, suns, factors);
      part_sums_[b].add_rays(of_band, rays, factors);
      part_sums_[b].add_sources(of_band, of_band_sources);
      light_band(b, of_band, of_band_sources, in_band(rays, factors, traced_.rules.errors));
    }
  }

  void light_band(std::size_t band, const Block& block, const BlockSources& sources,
                  BlockRays rays) {
    const PatchOptics& optics = traced_.optics_of_band[band];
    BatchTally& tally = tallies_[band];
    const Columns radiosity = light_patches(band, block, sources, rays.on_patches, tally);
    if (traced_.sensors.count() > 0)
      light_sensors(optics, block, sources, rays.on_sensors, radiosity, tally.sensors);
    book_sent_on(traced_, block, rays.sent_on, sums_[band], tally);
    sums_[band].add_sources(sources);
    if (of_instants()) errors_of_instants(band, block, sources, std::move(rays), tally);
  }

  /// Returns the radiosity that sensors see, if there are any.
  Columns light_patches(std::size_t band, const Block& block, const BlockSources& sources,
                        RayLight& rays, BatchTally& tally) {
    const Stopwatch time(work_[Work::solve_s]);
    const PatchOptics& optics = traced_.optics_of_band[band];
    const LineSet& lines = traced_.patches.lines.pooled;
    BlockLight light =
        block_light(traced_.hierarchy(), lines, optics, sources, std::move(rays.pooled),
                    traced_.patches.lamps.pooled, traced_.bounce_rules(band));
    const auto ledger = block_ledger(lines, optics, traced_.hierarchy().area(), sources, light);
    put_rows(ledger, block, tally.ledger);
    store_patches(optics, light, block.suns, block.rows, rays.sunlit, tally);
    return traced_.sensors.count() > 0 ? seen_radiosity(traced_.hierarchy(), optics, light)
                                       : Columns();
  }

  void light_sensors(const PatchOptics& optics, const Block& block, const BlockSources& sources,
                     RayLight& rays, const Columns& radiosity, ReceiverTally& tally) {
    const Stopwatch time(work_[Work::sensors_s]);
    const BlockLight light =
        sensor_light(traced_.sensors.lines.pooled, optics, sources, std::move(rays.pooled),
                     traced_.sensors.lamps.pooled, radiosity);
    store_received(light, block.suns, block.rows, rays.sunlit, tally);
  }

  /// Every realization of the block for itself.
  void errors_of_instants(std::size_t band, const Block& block, const BlockSources& sources,
                          BlockRays rays, BatchTally& tally) const {
    const PatchOptics& optics = traced_.optics_of_band[band];
    const std::size_t suns = block.suns.size();
    InstantSpread patches(traced_.patches.count(), suns), sensors(traced_.sensors.count(), suns);
    InstantSpreadBySource by_source(traced_.rules.by_source ? traced_.patches.count() : 0, suns);
    for (std::size_t r = 0; r < tally.ledger_instants.size(); ++r) {
      const LineSet& lines = traced_.patches.lines.realizations[r];
      const std::vector<double>& parallel = traced_.patches.lamps.of(r);
      BlockLight light = block_light(traced_.hierarchy(), lines, optics, sources,
                                     taken(rays.on_patches.of_realizations, r), parallel,
                                     traced_.bounce_rules(band));
      const auto ledger = block_ledger(lines, optics, traced_.hierarchy().area(), sources, light);
      put_rows(ledger, block, tally.ledger_instants[r]);
      patches.add(total_of(light));
      by_source.add(
          total_of(light),
          [&](std::size_t i, std::size_t k) {
            return static_cast<double>(rays.on_patches.by_samples[r][i * block_width + k]) +
                   (parallel.empty() ? 0 : parallel[i]);
          },
          [](std::size_t, std::size_t) { return 0; });
      sensors.add(total_of(sensors_of(r, optics, sources, rays.on_sensors, light)));
    }
    patches.store(block.rows, tally.irradiance_se);
    sensors.store(block.rows, tally.sensors.irradiance_se);
    by_source.store(block.rows, tally.se_by_source);
    book_instants(block, rays.sent_on, tally);
  }

  BlockLight sensors_of(std::size_t r, const PatchOptics& optics, const BlockSources& sources,
                        RayLight& rays, BlockLight& of_patches) const {
    if (traced_.sensors.count() == 0) return {};
    RayColumns columns = taken(rays.of_realizations, r);
    columns.circumsolar.clear();  // sensors see all of the sky by their lines
    return sensor_light(traced_.sensors.lines.realizations[r], optics, sources, std::move(columns),
                        traced_.sensors.lamps.of(r),
                        seen_radiosity(traced_.hierarchy(), optics, of_patches));
  }

  void book_instants(const Block& block, const std::vector<SunFates>& sent_on,
                     BatchTally& tally) const {
    for (std::size_t r = 0; r < sent_on.size(); ++r)
      for (std::size_t k = 0; k < block.suns.size(); ++k)
        tally.ledger_instants[r][block.rows[k]] += booked(sent_on[r][k]);
    const auto& of_lamps = traced_.patches.lamps.ledger;
    for (std::size_t r = 0; r < of_lamps.size(); ++r)
      for (std::size_t k = 0; k < block.suns.size(); ++k)
        tally.ledger_instants[r][block.rows[k]] += of_lamps[r];
  }

  const TracedScene& traced_;
  std::vector<BatchTally>& tallies_;
  WorkDone& work_;
  BatchRays rays_;
  std::vector<TimeSums> sums_;       ///< of each band
  std::vector<PartSums> part_sums_;  ///< likewise
};

}  // namespace

std::unique_ptr<BatchTransport> Gathering::begin(std::vector<BatchTally>& tallies, WorkDone& work,
                                                 RayRecord* record) const {
  return std::make_unique<GatheredBatch>(traced_, tallies, work, record);
}

}  // namespace sunload
