// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/variant_mesh.h"

#include <gtest/gtest.h>

#include "tests/support/study_plan.h"

namespace sunload::test {
namespace {

std::vector<std::uint64_t> patches_of(const std::string& solver) {
  const VariantPlan plan = plan_of(
      "format: sunload-study-1\nname: box\n"
      "site: {latitude_deg: 49.7475, longitude_deg: 13.3776, timezone: Europe/Prague}\n"
      "period: {start: \"2026-01-01 00:00\", end: \"2026-03-01 00:00\", step_min: 60}\n"
      "light: {source: clear_sky}\nscene: {builtin: {name: box_on_plane}}\n"
      "mesh: {light_tolerance: 0.05}\nsolver: {" +
      solver + "}\n");
  Watch watch;
  const VariantMesh made = make_mesh(plan, watch);
  EXPECT_GT(made.report.patches, made.report.patches_before);
  return made.mesh->key();
}

TEST(VariantMesh, DoesNotDependOnTheStudysSeed) {
  EXPECT_EQ(patches_of("seed: 1"), patches_of("seed: 2"));
}

}  // namespace
}  // namespace sunload::test
