// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// First light of a batch, kept for a scene of which rays tell the same: that differs in diffuse
/// reflectances, which decide only what becomes of the light.
#pragma once

#include <cstddef>
#include <vector>

#include "solver/traced/light_iteration.h"

namespace sunload {

/// Of one batch, in the order of its blocks.
struct RayRecord {
  double most_bytes = 0;  ///< a larger one is given up
  std::vector<BlockRays> blocks;
  RaySums on_patches, on_sensors;  ///< time integrals of the whole batch
  WorkDone work;                   ///< rays and beams; no seconds
  double bytes = 0;
  enum class State { written, whole, given_up } state = State::written;
};

/// The light iteration of one batch, block by block: traced, or as a record has it. Whoever takes
/// it gets the same bits either way.
class BatchRays {
 public:
  /// `record`: null where nothing is kept; a whole one is taken from, another is written, from
  /// nothing. It must outlive this.
  BatchRays(const TracedScene& traced, RayRecord* record);
  /// As `light_iteration`; the integrals in `sums` may come with `end` only.
  BlockRays next(const BlockSources& sources, const Kept& kept, TimeSums& sums, WorkDone& work);
  /// After the last block. `sums`: those of all blocks; null where they were not the same.
  void end(TimeSums* sums, WorkDone& work);

 private:
  bool takes() const { return record_ && record_->state == RayRecord::State::whole; }
  void keep(const BlockRays& rays);

  const TracedScene& traced_;
  RayRecord* record_;
  std::size_t taken_ = 0;  ///< blocks
};

}  // namespace sunload
