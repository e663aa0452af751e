// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Finished batches → result file.
#pragma once

#include <string>
#include <vector>

#include "io/plan/variant_plan.h"
#include "io/result/writer.h"

namespace sunload {

class Hierarchy;

/// Geometry of the result: the frozen mesh with its tables.
ResultGeometry result_geometry(const VariantPlan& plan, const Hierarchy& hierarchy);

/// Numbers of the batches that are missing or not valid, and why a file that is
/// there cannot be used.
struct MissingBatches {
  std::vector<std::size_t> numbers;
  std::vector<std::string> reasons;
};
MissingBatches missing_batches(const std::string& folder, const VariantPlan& plan);

/// Numbers of the batches whose file is not there at all: a look at the folder,
/// without reading them.
std::vector<std::size_t> batches_not_there(const std::string& folder, const VariantPlan& plan);

/// Puts all batches together in batch order: first the sums of every
/// realization, then means and errors. Memory does not grow with the period.
/// Throws InputError where a batch is missing or not valid (check first), but
/// for those that are to be left out: their rows are missing values, and sums are
/// those of the other batches. Returns warnings that only the results bring to light.
std::vector<std::string> merge_variant(const std::string& folder, const VariantPlan& plan,
                                       const StudyFile& file, const Hierarchy& hierarchy,
                                       const std::string& path,
                                       const std::vector<std::size_t>& left_out = {});

}  // namespace sunload
