// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Time sums that are free of the error of few solutions.
///
/// Light that is made up of few solutions has much the same error on all patches of a facade: their
/// mean keeps it, while errors of lines average out. The realizations are solved with the exact
/// sources, integrated over time, and their sums lack this error; the mean of the realizations
/// equals what gathering on the pooled lines gives, within a tenth of its standard error. So light
/// of the sky and reflected light of a patch are scaled, batch by batch, until the sums of all
/// light over parts of the time, and of each kind over all of the time, are those of the
/// realizations. Where a kind brings nothing, nothing is added.
#pragma once

#include <array>
#include <vector>

#include "solver/base/chunks.h"
#include "solver/light/packed_columns.h"
#include "solver/light/tally.h"
#include "solver/mesh/patch_optics.h"
#include "solver/transport/light_transport.h"

namespace sunload {

/// Light of a block that is made up of few solutions, [N][block].
struct FewLight {
  Columns reflected, sky;
};

class ExactTotals {
 public:
  /// Keeps the light of a block that the tally has already. `sensors` has no rows where there are
  /// none.
  void keep(const Block& block, const FewLight& patches, const FewLight& sensors);
  /// Scales the kept light in the tally: series, time sums, parts, largest values. Parts of the
  /// time that have errors come first, then all of the time, which decides. Call it after
  /// `solve_realizations`.
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
  struct Kept {
    PackedColumns reflected, sky;
  };
  struct KeptBlock {
    std::size_t intervals;
    Kept patches, sensors;
  };
  void take(Kept KeptBlock::*of_receivers, ReceiverTally& tally,
            std::vector<double>& changed) const;
  Light light_of(Kept KeptBlock::*of_receivers, PackedColumns Kept::*kind, std::size_t begin,
                 std::size_t end) const;

  std::vector<Interval> intervals_;  ///< of all blocks
  std::vector<KeptBlock> blocks_;
};

}  // namespace sunload
