// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What the user asks of commands on studies.
#pragma once

#include <string>
#include <vector>

#include "io/run/progress.h"
#include "io/run/shard.h"
#include "io/study/study.h"

namespace sunload {

/// What becomes of results and batches that are there already.
enum class Existing { refuse, resume, overwrite };
/// What becomes of batch files after the merge.
enum class Batches { remove, keep };

/// Options of `sunload run`, `merge` and their like.
struct RunOptions {
  std::vector<std::string> variants;  ///< names; empty: all
  std::string output;                 ///< replaces output.folder
  Existing existing = Existing::refuse;
  Batches batches = Batches::remove;
  int threads = 0;  ///< 0: all permitted processors
  ProgressStyle progress = ProgressStyle::automatic;
  double time_limit_min = 0;  ///< 0: none
  Shard shard;                ///< which units are this process' own
};

/// Whether a path names a study where a result could stand, too: by its ending.
bool is_study(const std::string& path);
/// The variants that were asked for. Throws InputError for unknown names.
std::vector<Study> chosen_variants(const StudyFile& file, const RunOptions& options);
/// Folder of all results: that of `--output`, or the one that the study names.
std::string results_folder(const StudyFile& file, const RunOptions& options);
/// As many threads as were asked for, or as this process may use.
void use_threads(const RunOptions& options);

}  // namespace sunload
