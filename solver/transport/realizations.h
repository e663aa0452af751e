// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Every realization of a gathered batch once more, by itself, with sources integrated over time:
/// the spread of these totals is the standard error.
#pragma once

#include "solver/gather/time_sums.h"
#include "solver/traced/traced_scene.h"

namespace sunload {

/// Fills exposures and ledgers of all realizations, and exposures by source. `sums` are those of
/// the whole batch in that band; afterwards they are used up.
void solve_realizations(const TracedScene& traced, std::size_t band, TimeSums& sums,
                        BatchTally& tally);

}  // namespace sunload
