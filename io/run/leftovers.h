// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Removal of work: after its merge, and what killed processes left in a study's folder.
#pragma once

#include <string>

#include "io/plan/variant_plan.h"

namespace sunload {

/// Lock of a variant's merge.
std::string merge_lock_path(const std::string& folder, const Study& study);

/// Marks a variant's batches as wanted (--keep-batches): later runs leave them. Throws
/// MachineError.
void keep_work(const std::string& folder, const VariantPlan& plan);

/// Removes a variant's batches, its lines and all that belongs to them.
void remove_work(const std::string& folder, const VariantPlan& plan);

/// Removes the folders of a variant's work where nothing is in them.
void remove_empty_folders(const std::string& folder, const VariantPlan& plan);

/// Work of that hash whose result is there: a process was killed while it removed it, or two
/// processes computed the same. Does nothing where the work was kept on purpose, where another
/// process merges just now, or without the right to write.
void remove_finished_work(const std::string& folder, const Study& study, const std::string& hash);

/// Below `<folder>/<study>`, whatever the content hash: parts of files whose writers are gone
/// (`remove_left_aside`), locks that nobody holds, folders of work with nothing in them.
void remove_left_over(const std::string& folder, const std::string& study);

}  // namespace sunload
