// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Puts the light of a block of suns into a batch's tally, from its row `first_row` on.
#pragma once

#include <span>
#include <vector>

#include "solver/gather/block_light.h"
#include "solver/light/tally.h"

namespace sunload {

/// What receivers get; `sunlit`: share of each that sees the sun ([N][block]).
void store_received(const BlockLight& light, std::span<const IntervalLight> block,
                    std::size_t first_row, const Columns& sunlit, ReceiverTally& tally);

/// What patches get and what leaves them.
void store_patches(const PatchOptics& optics, const BlockLight& light,
                   std::span<const IntervalLight> block, std::size_t first_row,
                   const Columns& sunlit, BatchTally& tally);

}  // namespace sunload
