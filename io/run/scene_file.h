// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The scene of a study before any light, for those who read results.
#pragma once

#include <string>

#include "io/base/file_aside.h"
#include "io/plan/variant_plan.h"
#include "io/study/study.h"

namespace sunload {

/// A result file without light: patches before refinement with their names, materials and kinds of
/// surface, sensors, times and sun positions, and no total and no series. It lies beside an output,
/// under a name of its own, and goes with the object.
class SceneFile {
 public:
  /// Throws InputError beyond the largest number of patches or where no surface is left,
  /// MachineError where the file cannot be written.
  SceneFile(const VariantPlan& plan, const StudyFile& file, const std::string& output);
  const std::string& path() const { return file_.aside(); }

 private:
  FileAside file_;
};

}  // namespace sunload
