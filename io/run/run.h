// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The driver: `sunload run` and `sunload merge`, from the study's file to its results.
#pragma once

#include <string>

#include "io/run/options.h"
#include "io/run/variant_job.h"

namespace sunload {

/// Computes what is missing, variant after variant. Each is merged, and its memory given back, as
/// soon as its last batch is there. Returns the exit code; throws InputError (with every problem
/// of all variants, before anything is computed), MachineError, Interrupted.
int run_study(const std::string& study, const RunOptions& options);

/// Puts finished batches together; exit code 75 and their list where some are
/// missing. `partial` writes what is there to `.work/…/partial.h5`.
int merge_study(const std::string& study, const RunOptions& options, Merge merge);

}  // namespace sunload
