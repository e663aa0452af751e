// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What a plan leaves on disk while it runs: batches, the prepared file, the result
/// (`WorkEstimate::disk_bytes`).
#pragma once

#include "io/plan/variant_plan.h"

namespace sunload {

/// What series take, per patch and band.
struct SeriesBytes {
  double of_batch = 0, of_merge = 0, on_disk = 0;
};

/// In batches and in the result; of dark intervals next to nothing. Sums over steps are doubles,
/// beside the series of intervals that measures watch; merge holds a row of chunks.
SeriesBytes series_bytes(const VariantPlan& plan, double series, double value_bytes);

/// Lines and skies and suns of few that a process leaves for those that come later; of sensors
/// nothing. Written where there are two batches, and the scene is one in all seasons.
double prepared_bytes(const VariantPlan& plan, double patches, double lines_per_patch, bool guided,
                      double node_bytes);

/// The result but for series and parts of the period.
double result_bytes(const VariantPlan& plan, double n, double parts, double bands);

/// Sun, sky, ledger and facades' means of every interval in batches and result, and what batches
/// have besides.
double interval_bytes(const VariantPlan& plan, double bands, double value_bytes);

}  // namespace sunload
