// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// First light of a batch, kept for another scene on which rays would bring the same. Such a scene
/// differs in diffuse reflectances only: these decide what becomes of the light, not what rays
/// bring.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "solver/traced/light_iteration.h"

namespace sunload {

/// Whether rays are cast to the bright sky about the sun: some transports solve it elsewhere.
enum class SunsSky { by_rays, elsewhere };

/// What the rays of one batch brought, in the order of its blocks.
struct RayRecord {
  double most_bytes = 0;  ///< a larger one is given up
  SunsSky suns_sky = SunsSky::by_rays;
  std::vector<BlockRays> blocks;
  std::vector<RaySums> on_patches, on_sensors;  ///< of the whole batch, of all sums over time
  WorkDone work;                                ///< rays and beams; no seconds
  double bytes = 0;
  /// written: blocks are being added; whole: the batch is complete and can be taken from; given_up:
  /// it would have exceeded `most_bytes`, and holds nothing.
  enum class State { written, whole, given_up } state = State::written;
};

/// The light iteration of one batch, block by block: traced, or taken from a record. The bits are
/// the same either way.
class BatchRays {
 public:
  /// `record`: null where nothing is kept. A whole record is read if its sky about the sun was
  /// solved as `suns_sky` says; else it is left alone, and rays are traced. Any other record is
  /// emptied and written. The record must outlive this object.
  BatchRays(const TracedScene& traced, SunsSky suns_sky, RayRecord* record);
  /// As `light_iteration`; what goes into `sums` from a record comes with `end` only.
  BlockRays next(const BlockSources& sources, const Kept& kept, std::span<const TimedSums> sums,
                 WorkDone& work);
  /// Call it after the last block. `sums`: all sums that any block was given, in an order that is
  /// the same when the record is written and when it is read.
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
