// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/traced/rules.h"

#include <algorithm>

#include "geo/base/check.h"
#include "solver/base/amount.h"
#include "solver/base/random_blocks.h"

namespace sunload {

namespace {

/// Each iteration has random numbers of its own.
constexpr int most_bounces = static_cast<int>(shot_blocks::of_iterations.count) - 1;

}  // namespace

void expect_valid(const SolverRules& rules) {
  SUNLOAD_EXPECT(rules.bounces >= 0 && rules.bounces <= most_bounces, "bounces are 0 … 2047");
  SUNLOAD_EXPECT(rules.mirror_depth >= 0 && rules.mirror_depth <= most_reflections,
                 "mirror_depth is 0 … most_reflections");
  SUNLOAD_EXPECT(rules.realizations >= 1, "at least one realization");
  const auto is_shared = [&](int count) { return count >= 1 && count % rules.realizations == 0; };
  SUNLOAD_EXPECT(is_shared(rules.lines_per_patch),
                 "lines_per_patch is shared equally by the realizations");
  SUNLOAD_EXPECT(std::all_of(rules.lines_of_patch.begin(), rules.lines_of_patch.end(), is_shared),
                 "lines_of_patch are shared equally by the realizations");
  SUNLOAD_EXPECT(is_shared(rules.direct_samples),
                 "direct_samples are shared equally by the realizations");
  for (const double share : {rules.unshot, rules.faint_glint, rules.link_threshold})
    SUNLOAD_EXPECT(is_amount(share), "unshot, faint_glint and link_threshold are 0 or more");
  for (const int most : {rules.most_sun_beams, rules.most_faint_beams, rules.most_sensor_beams})
    SUNLOAD_EXPECT(most >= 0, "numbers of beams are 0 or more");
  const double watts = rules.power_per_sample_w.value_or(1);
  SUNLOAD_EXPECT(is_amount(watts) && watts > 0, "power_per_sample_w is above 0");
  SUNLOAD_EXPECT(rules.samples_per_patch.value_or(1) >= 1, "samples_per_patch is 1 or more");
}

}  // namespace sunload
