// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What every transport that gathers over lines adds up beside the series.
#pragma once

#include "solver/gather/time_sums.h"
#include "solver/traced/light_iteration.h"
#include "solver/transport/light_transport.h"

namespace sunload {

/// Of a batch, all zeros.
TimeSums empty_sums(const TracedScene& traced);

/// The sun's light that mirrors sent on, and that of parallel sources.
void book_sent_on(const TracedScene& traced, const Block& block,
                  const std::vector<SunFates>& sent_on, TimeSums& sums, BatchTally& tally);

/// Ledgers of the block's suns, to their places in the batch.
void put_rows(const std::vector<Ledger>& of_block, const Block& block, std::vector<Ledger>& ledger);

/// The columns of realization r, which are not needed afterwards.
RayColumns taken(SunColumns& columns, std::size_t r);

}  // namespace sunload
