// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Whether this machine has room for a variant: what `run` refuses and `check` warns of.
#pragma once

#include <string>

#include "io/plan/work_estimate.h"

namespace sunload {

/// Where the number of patches in an estimate is from: counted on a mesh or, before there is one,
/// the fewest that there can be.
enum class PatchesAre { counted, at_least };

/// Why memory does not suffice, and what to try; empty where it does.
std::string memory_problem(const WorkEstimate& work, PatchesAre patches = PatchesAre::counted);

/// The same of the pilot that decides the counts where `solver.accuracy` asks for it.
std::string accuracy_pilot_problem(const VariantPlan& plan, std::size_t patches);

/// The same of the disk that results go to, `finished_bytes` of which are there already: it may
/// also be read-only, or have no inodes for more files.
std::string disk_problem(const WorkEstimate& work, const std::string& folder,
                         double finished_bytes = 0);

}  // namespace sunload
