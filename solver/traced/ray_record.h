// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// First light of a batch, kept for a scene of which rays tell the same: that differs in diffuse
/// reflectances, which decide only what becomes of the light.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "solver/traced/light_iteration.h"

namespace sunload {

/// Whether rays are cast to the bright sky about the sun: some transports solve it elsewhere.
enum class SunsSky { by_rays, elsewhere };

/// Of one batch, in the order of its blocks.
struct RayRecord {
  double most_bytes = 0;  ///< a larger one is given up
  SunsSky suns_sky = SunsSky::by_rays;
  std::vector<BlockRays> blocks;
  std::vector<RaySums> on_patches, on_sensors;  ///< of the whole batch, of all sums over time
  WorkDone work;                                ///< rays and beams; no seconds
  double bytes = 0;
  enum class State { written, whole, given_up } state = State::written;
};

/// The light iteration of one batch, block by block: traced, or as a record has it. Whoever takes
/// it gets the same bits either way.
class BatchRays {
 public:
  /// `record`: null where nothing is kept; a whole one is taken from where its rays are those that
  /// are wanted, and else left alone; another is written, from nothing. It must outlive this.
  BatchRays(const TracedScene& traced, SunsSky suns_sky, RayRecord* record);
  /// As `light_iteration`; what goes into `sums` may come with `end` only.
  BlockRays next(const BlockSources& sources, const Kept& kept, std::span<const TimedSums> sums,
                 WorkDone& work);
  /// After the last block. `sums`: all that any block had, in the same order for all who take it.
  void end(std::span<TimeSums* const> sums, WorkDone& work);

 private:
  bool takes() const { return record_ && record_->state == RayRecord::State::whole; }
  void keep(const BlockRays& rays);
  void keep(std::span<TimeSums* const> sums);

  const TracedScene& traced_;
  RayRecord* record_;
  std::size_t taken_ = 0;  ///< blocks
};

}  // namespace sunload
