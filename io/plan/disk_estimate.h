// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What a plan leaves on disk while it runs: batches, the prepared file, the result
/// (`WorkEstimate::disk_bytes`).
#pragma once

#include "io/plan/variant_plan.h"

namespace sunload {

struct Workload;

/// What series take, per patch and band.
struct SeriesBytes {
  double of_batch = 0, of_merge = 0, on_disk = 0;
};

/// In batches and in the result; of dark intervals next to nothing. Sums over steps are doubles,
/// beside the series of intervals that measures watch; merge holds a row of chunks.
SeriesBytes series_bytes(const VariantPlan& plan, double series, double value_bytes);

/// Batches, the prepared file and the result together.
double disk_bytes(const Workload& work);

}  // namespace sunload
