// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/options.h"

#include <algorithm>

#include "geo/base/check.h"
#include "io/base/machine.h"
#include "solver/base/threads.h"

namespace sunload {

bool is_study(const std::string& path) { return path.ends_with(".yaml") || path.ends_with(".yml"); }

std::vector<Study> chosen_variants(const StudyFile& file, const RunOptions& options) {
  if (options.variants.empty()) return file.variants;
  std::vector<Study> chosen;
  Problems problems;
  for (const auto& name : options.variants) {
    const auto found = std::find_if(file.variants.begin(), file.variants.end(),
                                    [&](const Study& s) { return s.variant == name; });
    if (found != file.variants.end()) {
      const bool is_chosen = std::any_of(chosen.begin(), chosen.end(),
                                         [&](const Study& s) { return s.variant == name; });
      if (!is_chosen) chosen.push_back(*found);
      continue;
    }
    std::string names;
    for (const auto& v : file.variants) names += (names.empty() ? "" : ", ") + v.variant;
    problems.add({file.path}, "no variant '" + name + "'", {}, "the study has: " + names);
  }
  problems.throw_if_any();
  return chosen;
}

std::string results_folder(const StudyFile& file, const RunOptions& options) {
  return options.output.empty() ? file.variants.front().output.folder : options.output;
}

void use_threads(const RunOptions& options) {
  set_thread_count(options.threads > 0 ? options.threads : permitted_processors());
}

}  // namespace sunload
