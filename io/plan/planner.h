// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Plans of the variants of a study, thousands of them perhaps.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/plan/variant_plan.h"

namespace sunload {

/// Makes plans one after the other. What a variant has in common with the one before is not done
/// again: files read and prepared where the scene differs in its materials alone, what is covered
/// cut out where light passes the same surfaces, sun path and
/// light where these are of the same keys and the same place. A plan is the same as that of
/// `make_plan`.
class Planner {
 public:
  /// As `make_plan`.
  VariantPlan plan(const Study& study);

 private:
  const BuiltScene& scene_before_materials(const Study& study);
  const BuiltScene& scene_uncovered(const Study& study);
  const LightSeries& light(const Study& study, const Site& site);

  std::string scene_key_, light_key_;  ///< empty: nothing is there yet
  BuiltScene scene_, uncovered_;
  std::vector<std::uint8_t> covers_;  ///< that `uncovered_` was made by
  bool is_uncovered_ = false;         ///< `uncovered_` is of `scene_`
  LightSeries light_;
};

}  // namespace sunload
