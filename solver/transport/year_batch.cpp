// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/transport/year_batch.h"

#include <utility>

#include "solver/base/stopwatch.h"
#include "solver/gather/block_tally.h"
#include "solver/gather/sensor_light.h"
#include "solver/transport/band_rays.h"
#include "solver/transport/exact_totals.h"
#include "solver/transport/gathered_sums.h"
#include "solver/transport/part_sums.h"
#include "solver/transport/realizations.h"

namespace sunload {

namespace {

/// One band of a batch.
class YearBand {
 public:
  YearBand(const TracedScene& traced, std::size_t band, const NodeLight& nodes, BatchTally& tally)
      : traced_(traced),
        optics_(traced.optics_of_band[band]),
        band_(band),
        nodes_(nodes),
        tally_(tally),
        sums_(empty_sums(traced)),
        parts_(traced, band, tally),
        shares_of_parts_(parts_.count()) {}

  /// What the rays of a block are added to as they are traced, where they are of this band.
  std::vector<TimedSums> timed(const Block& block) { return parts_.timed(block, sums_); }
  /// Of the whole batch.
  std::vector<TimeSums*> sums() { return parts_.all(sums_); }
  /// Adds rays that were traced for all bands; the block has this band's light.
  void add_rays(const Block& block, const BlockRays& rays, const BandFactors& factors) {
    add_exposures(rays, factors, block.suns, sums_);
    parts_.add_rays(block, rays, factors);
  }

  /// All are of this band; `rays` are used up.
  void light(const Block& block, const BlockSources& sources, BlockRays& rays) {
    const auto by_rays = ledger_of_rays(traced_, optics_, rays.on_patches.pooled.direct,
                                        rays.on_patches.pooled.mirror, block.suns.size());
    const auto weights = nodes_.weights(block.suns, by_rays);
    put_rows(by_rays, block, tally_.ledger);
    parts_.add_sources(block, sources, PartSums::Sky::whole);
    for (std::size_t p = 0; p < parts_.count(); ++p)
      add_shares(block, weights, parts_.shares(p, block), shares_of_parts_[p]);
    Columns seen;
    const FewLight on_patches = light_patches(block, weights, rays.on_patches, seen);
    exact_.keep(block, on_patches,
                traced_.sensors.count() > 0
                    ? light_sensors(block, sources, weights, seen, rays.on_sensors)
                    : FewLight());
    book_sent_on(traced_, block, rays.sent_on, sums_, tally_);
    sums_.add_whole_sources(sources);
    add_shares(block, weights, std::vector<double>(block.suns.size(), 1), shares_);
  }

  void finish() {
    nodes_.split_circumsolar(shares_, sums_);
    solve_realizations(traced_, band_, sums_, tally_);
    for (std::size_t p = 0; p < parts_.count(); ++p)
      nodes_.split_circumsolar(shares_of_parts_[p], parts_.sums(p));
    parts_.solve();
    exact_.take(optics_, tally_);
  }

 private:
  /// Return what is made up of few solutions. `seen`: radiosity of the patches in the light of
  /// their intervals, where sensors see it.
  FewLight light_patches(const Block& block, const std::vector<NodeWeights>& weights,
                         RayLight& rays, Columns& seen) {
    BlockLight light = nodes_.light(traced_.patches, &NodeBlock::patches, weights, rays);
    if (traced_.sensors.count() > 0 && !traced_.bounce_rules(band_).beyond.empty())
      seen = radiosity_of_all_light(traced_.hierarchy(), optics_, light);
    for (std::size_t k = 0; k < block.suns.size(); ++k)
      tally_.ledger[block.rows[k]] += nodes_.ledger(weights, k);
    store_patches(optics_, light, block.suns, block.rows, rays.sunlit, tally_);
    return {std::move(light.reflected), std::move(light.sky)};
  }

  /// What a sensor beside a surface sees is one patch or two, and nodes do not know in which hour a
  /// shadow leaves them: the light is gathered anew where all of it is seen (seen_radiosity).
  FewLight light_sensors(const Block& block, const BlockSources& sources,
                         const std::vector<NodeWeights>& weights, const Columns& seen,
                         RayLight& rays) {
    BlockLight light = nodes_.light(traced_.sensors, &NodeBlock::sensors, weights, rays);
    if (!seen.empty())
      light.reflected = reflected_on_sensors(traced_.sensors.lines.pooled, sources, seen);
    store_received(light, block.suns, block.rows, rays.sunlit, tally_.sensors);
    return {std::move(light.reflected), std::move(light.sky)};
  }

  /// Time that each node shines, in all intervals together, of each so much of its time.
  static void add_shares(const Block& block, const std::vector<NodeWeights>& weights,
                         const std::vector<double>& of_suns, std::vector<NodeSeconds>& shares) {
    shares.resize(weights.size());
    for (std::size_t b = 0; b < weights.size(); ++b)
      for (std::size_t j = 0; j < block_width; ++j)
        for (std::size_t k = 0; k < block.suns.size(); ++k)
          shares[b][j] += static_cast<double>(weights[b].of[j * block_width + k]) *
                          (of_suns[k] * block.suns[k].length_s);
  }

  const TracedScene& traced_;
  const PatchOptics& optics_;
  std::size_t band_;
  const NodeLight& nodes_;
  BatchTally& tally_;
  TimeSums sums_;
  PartSums parts_;
  ExactTotals exact_;
  std::vector<NodeSeconds> shares_;  ///< of each block of nodes
  std::vector<std::vector<NodeSeconds>> shares_of_parts_;
};

/// One batch.
class YearBatch : public BatchTransport {
 public:
  YearBatch(const TracedScene& traced, const std::vector<std::unique_ptr<NodeLight>>& nodes,
            std::vector<BatchTally>& tallies, WorkDone& work, RayRecord* record)
      : traced_(traced), work_(work), rays_(traced, SunsSky::elsewhere, record) {
    bands_.reserve(tallies.size());
    for (std::size_t b = 0; b < tallies.size(); ++b)
      bands_.emplace_back(traced, b, *nodes[b], tallies[b]);
  }

  void light(const Block& block) override {
    const BlockSources sources(block.suns, static_cast<std::size_t>(traced_.grid.cell_count()));
    if (traced_.is_rgb()) return light_in_bands(block, sources);
    BlockRays rays = rays_.next(sources, {}, bands_.front().timed(block), work_);
    const Stopwatch time(work_[Work::solve_s]);
    bands_.front().light(block, sources, rays);
  }

  void finish() override {
    const Stopwatch time(work_[Work::realizations_s]);
    rays_.end(traced_.is_rgb() ? std::vector<TimeSums*>() : bands_.front().sums(), work_);
    for (YearBand& band : bands_) band.finish();
  }

 private:
  /// Rays are traced once, for the mean of the bands.
  void light_in_bands(const Block& block, const BlockSources& sources) {
    const BlockRays rays = rays_.next(sources, {.columns = true}, {}, work_);
    const Stopwatch time(work_[Work::solve_s]);
    for (std::size_t b = 0; b < bands_.size(); ++b) {
      const auto suns = suns_in_band(block.suns, b);
      const Block of_band{suns, block.rows};
      const BandFactors factors = sun_factors(block.suns, suns);
      bands_[b].add_rays(of_band, rays, factors);
      BlockRays rays_of_band = in_band(rays, factors, Errors::totals);
      bands_[b].light(of_band, BlockSources(suns, sources.sky.size() / block_width), rays_of_band);
    }
  }

  const TracedScene& traced_;
  WorkDone& work_;
  BatchRays rays_;
  std::vector<YearBand> bands_;
};

}  // namespace

std::unique_ptr<BatchTransport> year_batch(const TracedScene& traced,
                                           const std::vector<std::unique_ptr<NodeLight>>& nodes,
                                           std::vector<BatchTally>& tallies, WorkDone& work,
                                           RayRecord* record) {
  return std::make_unique<YearBatch>(traced, nodes, tallies, work, record);
}

}  // namespace sunload
