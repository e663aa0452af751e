// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The driver: `sunload run`, `merge`, `check` on a study.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/base/exit_code.h"
#include "io/plan/sky_dome.h"
#include "io/run/progress.h"
#include "io/run/shard.h"
#include "io/study/study.h"

namespace sunload {

enum class Existing { refuse, resume, overwrite };
enum class Batches { remove, keep };
enum class Merge { complete, partial };

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

/// Computes what is missing, merges, prints one block per variant on stderr.
int run_study(const std::string& study, const RunOptions& options);

/// Puts finished batches together; exit code 75 and their list where some are
/// missing. `partial` writes what is there to `.work/…/partial.h5`.
int merge_study(const std::string& study, const RunOptions& options, Merge merge);

enum class CheckFormat { text, json };
/// Whether triangles that cut through others are sought: some 10 s for a million.
enum class SearchIntersections { no, yes };
/// Reads everything, reports scene, sun path, work, memory, disk on stdout.
int check_study(const std::string& study, const RunOptions& options, CheckFormat format,
                SearchIntersections search = SearchIntersections::no);

/// The sun path as CSV on stdout (docs/developer/design.md, Commands and exit codes), or as a
/// sun-path diagram where `picture` names one.
int print_sun(const std::string& study, const std::string& picture = {});

struct SkyOptions {
  std::string time;
  std::string picture;                     ///< fisheye instead of CSV
  std::optional<Subdivision> subdivision;  ///< of the CSV
  SkyPictureRules rules;
};
/// The sky dome of the first variant at one instant, as CSV on stdout or as a picture.
int print_sky(const std::string& study, const SkyOptions& options);

/// The variants that were asked for, with their folder. Throws InputError for unknown names.
std::vector<Study> chosen_variants(const StudyFile& file, const RunOptions& options);

}  // namespace sunload
