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

TEST(ExpectedError, TellsOfGlossThatMirrorsShineUpon) {
  const auto told = [](const std::string& mirror, const std::string& transport) {
    const VariantPlan plan = plan_of(
        "format: sunload-study-1\nname: facing\n"
        "period: {positions: [{azimuth_deg: 180, elevation_deg: 45, interval_min: 60}]}\n"
        "light: {source: fixed, dni_w_m2: 800, dhi_w_m2: 0, far_ground_albedo: 0}\n"
        "scene: {builtin: {name: box_on_plane}, materials: {smooth: {mirror: " +
        mirror +
        "}, brushed: {glossy: 0.4, glossy_exponent: 30}}, assign: [{surface: wall, material: "
        "smooth}, {surface: roof, material: brushed}, {surface: ground, material: brushed}, "
        "{surface: other, material: brushed}]}\nmesh: {oracle: none}\nsolver: {transport: " +
        transport + "}\n");
    Watch watch;
    const auto warnings = expected_error_warnings(plan, *make_mesh(plan, watch).mesh);
    return std::ranges::any_of(warnings, [](const std::string& warning) {
      return warning.find("mirrors (smooth) send to glossy surfaces (brushed)") != warning.npos;
    });
  };
  EXPECT_TRUE(told("0.5", "gather"));
  EXPECT_FALSE(told("0.5", "shoot"));
  EXPECT_FALSE(told("0.08", "gather"));
}

}  // namespace
}  // namespace sunload::test
