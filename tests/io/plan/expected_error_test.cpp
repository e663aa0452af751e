// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/expected_error.h"

#include <gtest/gtest.h>

#include "tests/support/study_plan.h"

namespace sunload::test {
namespace {

std::vector<std::string> warnings_of_mesh(const std::string& rules) {
  const VariantPlan plan = plan_of(night_study("room", "mesh: {oracle: none, " + rules + "}\n"));
  Watch watch;
  return expected_error_warnings(plan, *make_mesh(plan, watch).mesh);
}

TEST(ExpectedError, TellsWhereTheLeastAreaKeepsEdgesLong) {
  EXPECT_TRUE(warnings_of_mesh("max_edge_m: 1, min_area_m2: 0.01").empty());
  const auto kept = warnings_of_mesh("max_edge_m: 0.1, min_area_m2: 0.01");
  ASSERT_EQ(kept.size(), 1u);
  EXPECT_NE(kept[0].find("mesh.min_area_m2 0.01 keeps"), std::string::npos) << kept[0];
  // What it proposes does.
  const std::string before = "are not split; ";
  const auto at = kept[0].find(before);
  ASSERT_NE(at, std::string::npos) << kept[0];
  const std::string proposed = kept[0].substr(at + before.size());
  EXPECT_TRUE(
      warnings_of_mesh("max_edge_m: 0.1, min_area_m2: " + proposed.substr(0, proposed.find(' ')))
          .empty())
      << kept[0];
}

}  // namespace
}  // namespace sunload::test
