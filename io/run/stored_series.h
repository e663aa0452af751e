// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Which series a study stores, and how.
#pragma once

#include <string>
#include <vector>

#include "io/batch/batch_tally.h"
#include "io/plan/variant_plan.h"

namespace sunload {

/// Series arrays that batches of the study do not hold. Where series are of steps, arrays of
/// intervals are not held either, but for those that measures watch.
std::vector<std::string> unwanted_series(const Study& study);
/// Number of the step that a batch begins in.
std::size_t first_step(const VariantPlan& plan, std::size_t batch);

/// What a batch holds of the series.
StoredSeries stored_series(const VariantPlan& plan, std::size_t batch);

}  // namespace sunload
