// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Puts the light of a block of suns into a batch's tally.
#pragma once

#include <span>
#include <vector>

#include "solver/gather/block_light.h"
#include "solver/light/tally.h"

namespace sunload {

/// Stores what receivers get. `rows`: the row of each sun in the tally; `sunlit`: share of each
/// receiver that sees the sun ([N][block]).
void store_received(const BlockLight& light, std::span<const IntervalLight> block,
                    std::span<const std::size_t> rows, const Columns& sunlit, ReceiverTally& tally);

/// Stores what patches get and what leaves them.
void store_patches(const PatchOptics& optics, const BlockLight& light,
                   std::span<const IntervalLight> block, std::span<const std::size_t> rows,
                   const Columns& sunlit, BatchTally& tally);

}  // namespace sunload
