// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Materials that a study defines and no surface has.
#pragma once

#include <map>
#include <string>

#include "io/plan/variant_plan.h"
#include "io/study/study.h"

namespace sunload {

class Planner;

/// Looks for what uses the materials of scene.materials: faces and files of the scene, rules,
/// steps, seasons, the ground. A definition that one variant uses is not idle in the others, such
/// as one for a body that only that variant adds.
class MaterialUses {
 public:
  /// Both must outlive it.
  MaterialUses(const StudyFile& file, Planner& planner) : file_(file), planner_(planner) {}

  /// Adds to the plan's warnings its materials that no variant of the study uses.
  void warn_of_idle(VariantPlan& plan);

 private:
  bool is_used_anywhere(const std::string& material);

  const StudyFile& file_;
  Planner& planner_;
  std::map<std::string, bool> used_;  ///< of those that were looked for in all variants
};

}  // namespace sunload
