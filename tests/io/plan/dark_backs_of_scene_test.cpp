// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Two sides of a house's walls, as materials and files give them.
#include <gtest/gtest.h>

#include <algorithm>

#include "io/plan/scene_build.h"
#include "tests/support/study_plan.h"

namespace sunload::test {
namespace {

VariantPlan street(const std::string& brick, const std::string& more = "") {
  return plan_of(
      "format: sunload-study-1\nname: t\n"
      "site: {latitude_deg: 50, longitude_deg: 14, timezone: Europe/Prague}\n"
      "period: {days: [2026-06-21], step_min: 60}\nlight: {source: clear_sky}\n"
      "scene: {builtin: {name: street, house_3: brick}, materials: {brick: {diffuse: 0.3, " +
      brick + "}" + more + "}}\nmesh: {oracle: none}\n");
}

std::size_t two_sided(const VariantPlan& plan) {
  const auto& sides = plan.built.scene.mesh.triangle_sides;
  return static_cast<std::size_t>(std::ranges::count(sides, Sides::two));
}

TEST(DarkBacksOfAScene, AreNoPatches) {
  const auto one = street("sides: one"), two = street("sides: two");
  EXPECT_EQ(two_sided(one), 0u);
  EXPECT_EQ(two_sided(two), 0u);
  EXPECT_EQ(two.built.scene.mesh.triangle_count(), one.built.scene.mesh.triangle_count());
  EXPECT_GT(two.built.report.dark_backs_m2, 100);
  EXPECT_EQ(one.built.report.dark_backs_m2, 0);
}

/// A lamp may stand in a house.
TEST(DarkBacksOfAScene, ArePatchesWhereThereAreLamps) {
  const auto lamps = street("sides: two", ", door_paint: {diffuse: 0.2, emission_w_m2: 5}");
  EXPECT_GT(two_sided(lamps), 0u);
  EXPECT_EQ(lamps.built.report.dark_backs_m2, 0);
}

/// What light passes is in no closed body.
TEST(DarkBacksOfAScene, ArePatchesBehindScreens) {
  EXPECT_GT(two_sided(street("sides: two, transmittance: 0.2")), 0u);
}

}  // namespace
}  // namespace sunload::test
