// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What a result says of itself besides its datasets.
#pragma once

#include <string>
#include <vector>

#include "io/plan/variant_plan.h"
#include "io/result/writer.h"
#include "io/run/totals.h"

namespace sunload {

/// What a merged result is of.
struct MergedResult {
  const VariantPlan& plan;
  const StudyFile& file;
  const Totals& totals;
  const ResultGeometry& geometry;
  const std::vector<std::size_t>& left_out;  ///< batches that were not there
};

/// Root attributes (docs/result-file.md).
ResultAttributes result_attributes(const MergedResult& result);
/// What of them is known before any light: names, place, time zone.
ResultAttributes scene_attributes(const VariantPlan& plan);
/// Faults of the model that only the light brings out.
std::vector<std::string> result_warnings(const Totals& totals, const ResultGeometry& geometry);

}  // namespace sunload
