// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// How the samples of a shot are shared by the patches.
///
/// All suns k of a block share their samples. The pmf over patches is one
/// mixture of what each sun has to shoot,
///
///     q_i = (1/S) Σ_k P_i[k] / P_T[k],     P_T[k] = Σ_i P_i[k],   S suns with power,
///
/// positive wherever any sun has power. Stratified rounding with one random
/// offset ξ (docs/developer/method.md, Shooting) gives a patch N_i samples, but never less than one
/// where it has power, and each of them carries P_i[k] / N_i. Given N_i, every sample is an
/// unbiased one of P_i, so that the estimate is unbiased for any N_i ≥ 1, and a patch sends exactly
/// what it has: the ledger closes. (The weights P_i / (N q_i) of Bekaert (1999) allow N_i = 0, but
/// conserve energy only in the mean as soon as several suns share a pmf.)
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/light/sun_block.h"

namespace sunload {

/// Power of each sun of a block, summed over patches [W].
using SunTotals = std::array<double, block_width>;

/// P_T[k] of powers [N][block].
SunTotals total_power(const DoubleColumns& power);

/// N_i for about `samples` samples; `offset` ξ in [0, 1). Throws InputError where
/// more than most_samples would result.
std::vector<std::uint32_t> sample_counts(const DoubleColumns& power, const SunTotals& total,
                                         double samples, double offset);

/// Of one shot of one realization: 16 bytes each have to be kept.
inline constexpr double most_samples = 2e9;

/// Throws InputError that tells how many one shot of a realization would take.
[[noreturn]] void refuse_samples(double samples);

}  // namespace sunload
