// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Time sums of parts of a batch's time, from which every realization solves once for each of them.
#pragma once

#include <span>
#include <vector>

#include "solver/transport/band_rays.h"
#include "solver/transport/light_transport.h"

namespace sunload {

/// Of one band. Light is linear: what a realization receives in a part of the time follows from the
/// part's own integrals of sources and of rays, as the whole does from those of the whole.
class PartSums {
 public:
  /// Parts of the tally with errors; `tally` must outlive it.
  PartSums(const TracedScene& traced, std::size_t band, BatchTally& tally);
  /// The sums of the whole, and of those parts that have time in the block: what light_iteration
  /// adds to.
  std::vector<TimedSums> timed(const Block& block, TimeSums& whole);
  /// The sums of the whole and of all parts.
  std::vector<TimeSums*> all(TimeSums& whole);
  /// Whether the sky of `sources` has its circumsolar part split off.
  enum class Sky { split, whole };
  /// Adds to all parts what is the same in all realizations: sky, far ground, time.
  void add_sources(const Block& block, const BlockSources& sources, Sky sky = Sky::split);
  /// What light_iteration has left in columns of the realizations: `rays` are those traced for all
  /// bands, `factors` of the band relative to them; the block has its light.
  void add_rays(const Block& block, const BlockRays& rays, const BandFactors& factors);
  std::size_t count() const { return parts_.size(); }
  /// Of the time of the block's suns.
  std::vector<double> shares(std::size_t part, const Block& block) const;
  TimeSums& sums(std::size_t part) { return parts_[part].sums; }
  /// Solves what has been added, into the tally's parts.
  void solve();

 private:
  struct OfPart {
    std::size_t part = 0;
    TimeSums sums;
  };
  using Parts = std::vector<const OfPart*>;  ///< at most `block_width`
  /// Side by side, as if the means over their time were suns: emitters shine all of it.
  void solve(const Parts& block);
  static std::vector<IntervalLight> mean_lights(const Parts& block);
  static RayColumns mean_rays(const Parts& block, RaySums TimeSums::*of, std::size_t realization);
  static void keep(const Parts& block, std::size_t realization, const BlockLight& light,
                   ReceiverTally& tally);

  const TracedScene& traced_;
  std::size_t band_;
  BatchTally& tally_;
  std::vector<OfPart> parts_;
};

}  // namespace sunload
