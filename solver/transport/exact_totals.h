// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Time sums that do not rest on few solutions.
///
/// What light made up of few solutions is off by is much alike on all patches of a facade: their
/// mean keeps it, while errors of lines average out. The realizations, which are solved with the
/// exact sources integrated over time, know the sums without it; their mean is what gathering on
/// the pooled lines gives within a tenth of its standard error. So the reflected light of a patch
/// is scaled, batch by batch, until its time sum is theirs, and those of parts of the time are. Of
/// what its total changes by, reflected light keeps what makes its own sum theirs, the sky the
/// rest.
#pragma once

#include <array>
#include <vector>

#include "solver/base/chunks.h"
#include "solver/light/packed_columns.h"
#include "solver/light/tally.h"
#include "solver/mesh/patch_optics.h"
#include "solver/transport/light_transport.h"

namespace sunload {

class ExactTotals {
 public:
  /// Keeps the reflected light of a block that was stored; no `sensors`: no rows.
  void keep(const Block& block, const Columns& patches, const Columns& sensors);
  /// Scales it in the tally: series, time sums, parts, largest values. Parts of the time that have
  /// errors come first, then all of it, which decides. After `solve_realizations`.
  void take(const PatchOptics& optics, BatchTally& tally) const;

  /// Values of consecutive receivers.
  template <class T>
  using OfChunk = std::array<T, receivers_per_chunk>;
  using Light = std::vector<OfChunk<float>>;  ///< [intervals]
  /// With light.
  struct Interval {
    std::size_t row;  ///< in the batch
    double length_s;
  };

 private:
  /// Of a block.
  struct Reflected {
    std::size_t intervals;
    PackedColumns patches, sensors;
  };
  void take(PackedColumns Reflected::*of_receivers, ReceiverTally& tally,
            std::vector<double>& changed) const;
  Light light_of(PackedColumns Reflected::*of_receivers, std::size_t begin, std::size_t end) const;

  std::vector<Interval> intervals_;  ///< of all blocks
  std::vector<Reflected> blocks_;
};

}  // namespace sunload
