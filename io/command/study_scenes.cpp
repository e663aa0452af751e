// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/command/study_scenes.h"

#include "io/base/output_target.h"
#include "io/base/standard_streams.h"
#include "io/plan/planner.h"
#include "io/study/named_files.h"

namespace sunload {

std::deque<SceneFile> study_scenes(const StudyFile& file, const std::vector<Study>& variants,
                                   const std::string& output) {
  expect_not_read(output, named_files(file));
  std::deque<SceneFile> files;
  Planner planner;
  tell_warnings(file.warnings);
  for (const Study& study : variants) {
    const VariantPlan plan = planner.plan(study);
    expect_not_read(output, plan.built.files);
    tell_warnings(plan.built.warnings, study.variant);
    files.emplace_back(plan, file, output);
  }
  return files;
}

}  // namespace sunload
