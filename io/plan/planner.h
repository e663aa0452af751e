// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Plans of the variants of a study, thousands of them perhaps.
#pragma once

#include <string>

#include "io/plan/recently_made.h"
#include "io/plan/variant_plan.h"

namespace sunload {

/// Makes plans one after the other, and reuses what earlier variants have in common with the next
/// one, as long as memory holds it. Files read and prepared are reused where the scene differs in
/// its materials alone (and in north, without a CRS); the scene without covered parts, where light
/// passes the same surfaces; sun path and light, where keys and place are the same. A plan is the
/// same as that of `make_plan`.
class Planner {
 public:
  /// As `make_plan`.
  VariantPlan plan(const Study& study);
  /// Without its hash.
  VariantPlan unhashed_plan(const Study& study);
  /// Its scene without materials; until the next call.
  const BuiltScene& scene_uncovered(const Study& study);

  /// All that the light of a plan's intervals depends on, but for how it is counted in bands.
  static std::string key_of_light(const Study& study, const Site& site);

 private:
  const BuiltScene& scene_before_materials(const Study& study, std::string& key);
  const LightSeries& light(const Study& study, const Site& site);

  static constexpr double most_triangles = 1e6, most_intervals = 1e6;  // some 200 MB of either
  RecentlyMade<BuiltScene> scenes_{most_triangles}, uncovered_{most_triangles};
  RecentlyMade<LightSeries> lights_{most_intervals};
};

}  // namespace sunload
