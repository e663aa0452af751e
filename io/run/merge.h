// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Finished batches → result file.
#pragma once

#include <string>
#include <vector>

#include "io/plan/variant_plan.h"
#include "io/run/work_folder.h"

namespace sunload {

class Hierarchy;

/// Puts all batches together in batch order, into the result file `path`: first the sums of every
/// realization, then means and errors. Memory does not grow with the period.
/// Throws InputError where a batch is missing or not valid (check first), but
/// for those that are to be left out: their rows are missing values, and sums are
/// those of the other batches. Returns warnings that only the results bring to light.
std::vector<std::string> merge_variant(const WorkFolder& folder, const VariantPlan& plan,
                                       const StudyFile& file, const Hierarchy& hierarchy,
                                       const std::string& path,
                                       const std::vector<std::size_t>& left_out = {});

}  // namespace sunload
