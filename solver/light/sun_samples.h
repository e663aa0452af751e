// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Several suns that stand for one interval, each for a part of its sunlit time.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "solver/light/sun_block.h"

namespace sunload {

/// The most suns of an interval, and the most intervals where there are several: together they are
/// the addresses of random numbers that a period has.
inline constexpr std::size_t most_sun_samples = 256, most_intervals_of_samples = 1u << 24;

/// Of these addresses the first are for `sun_samples`, where an interval has `direct_suns`, too.
inline constexpr std::size_t most_suns_beside_direct_ones = 64;

/// The direct light of a block, one sun of every interval at a time, for all that follows the sun
/// by rays. Together the s-th suns carry the DNI of their intervals, each its share; an
/// interval without an s-th sun is dark there. Each has random numbers of its own, the first those
/// of the interval. The sky is left out. One span where no interval has more than one sun.
std::vector<std::vector<IntervalLight>> suns_one_by_one(std::span<const IntervalLight> block);

/// Suns of one interval that are looked at side by side.
struct SunRow {
  std::size_t interval = 0;         ///< of the block
  std::vector<IntervalLight> suns;  ///< at most `block_width`, each a part as of `suns_one_by_one`
};
/// Whether any interval has suns for straight light alone (`direct_suns`).
bool any_direct_suns(std::span<const IntervalLight> block);
/// All of these, in the order of time; intervals that have none have no row. No row depends on
/// another interval.
std::vector<SunRow> direct_suns_in_rows(std::span<const IntervalLight> block);

/// Points that one net needs to estimate the share of a receiver that sees a sun no worse than so
/// many samples, which realizations share equally, do (solver/first_light/direct_sun.h).
std::size_t net_size(int samples, int realizations);

}  // namespace sunload
