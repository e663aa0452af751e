// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that stand above the land of the files.
#include "io/plan/scene_gaps.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/work_folder.h"

namespace sunload::test {
namespace {

/// Land that rises by 3 m in 10, and what a step adds to it.
BuiltScene on_a_slope(const std::string& step, const std::string& more = "") {
  const WorkFolder folder;
  folder.write("land.obj", "o land\nv 0 0 0\nv 40 0 12\nv 40 40 12\nv 0 40 0\nf 1 2 3 4\n");
  const std::string study =
      folder.write("slope.yaml",
                   "format: sunload-study-1\nname: slope\n"
                   "site: {latitude_deg: 52, longitude_deg: 4.4, timezone: UTC}\n"
                   "period: {days: [2026-03-21]}\nscene: {files: [land.obj], land: [land]" +
                       more + ", edit: [{add: " + step + "}]}\n");
  return build_scene(read_study(study).variants.front());
}

std::string told(const BuiltScene& built) {
  for (const auto& warning : built.warnings)
    if (warning.find("above the land of the model") != warning.npos) return warning;
  return {};
}

std::string box_at(const std::string& place, const std::string& height) {
  return "{name: house, box: {position_m: " + place + ", size_m: [10, 10, " + height + "]}}";
}

TEST(SceneGaps, HousesAddedOnASlopeAreWarnedOf) {
  const auto house = told(on_a_slope(box_at("[20, 20]", "12")));
  EXPECT_NE(house.find("1 bodies stand more than 0.3 m above the land of the model (house by 1.50 "
                       "m) (sun and sky pass below their walls)"),
            house.npos)
      << house;
  // Drawn down, or by the study's word.
  for (const char* ground : {", ground: {surface: feet, margin_m: 0}", ", ground: none"})
    EXPECT_EQ(told(on_a_slope(box_at("[20, 20]", "12"), ground)), "") << ground;
}

TEST(SceneGaps, WhatIsBuriedOrStandsFreeIsNot) {
  EXPECT_EQ(told(on_a_slope(box_at("[20, 20, 4]", "12"))), "");
  EXPECT_NE(told(on_a_slope(box_at("[20, 20, 12]", "12"))), "");
  EXPECT_EQ(told(on_a_slope(box_at("[20, 20, 12]", "0.5"))), "");  // a canopy
}

}  // namespace
}  // namespace sunload::test
