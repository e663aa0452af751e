// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/material_assign.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/study_plan.h"
#include "tests/support/work_folder.h"

namespace sunload::test {
namespace {

constexpr const char* wall_and_crown = R"(o wall
v 0 0 0
v 4 0 0
v 4 0 3
v 0 0 3
f 1 2 3 4
)";
constexpr const char* crown_obj = R"(o crown
v 1 -3 2
v 2 -3 2
v 2 -3 3
v 1 -3 3
f 1 2 3 4
)";

/// A wall of one file, and beside it a crown of a file that the study gives its material.
class Rules : public ::testing::Test {
 protected:
  Rules() {
    folder_.write("wall.obj", wall_and_crown);
    folder_.write("crown.obj", crown_obj);
  }

  VariantPlan plan(const std::string& assign) {
    return plan_of(
        "format: sunload-study-1\nname: t\nsite: {latitude_deg: 50, longitude_deg: 14, timezone: "
        "UTC}\n"
        "period: {instants: [\"2026-06-21 10:00\"]}\nlight: {source: clear_sky}\n"
        "scene: {files: [" +
        (folder_ / "wall.obj") + ", {file: " + (folder_ / "crown.obj") +
        ", material: leaves}], ground: {surface: none}, repair: none,\n"
        "  materials: {leaves: {diffuse: 0.1, transmittance: 0.3}, brick: {diffuse: 0.3}, snow: "
        "{diffuse: 0.8}},\n  assign: [" +
        assign + "]}\n");
  }
  static std::string material_of(const VariantPlan& plan, const std::string& object) {
    const Scene& scene = plan.built.scene;
    for (std::size_t t = 0; t < scene.mesh.triangle_count(); ++t)
      if (scene.mesh.object_names[scene.mesh.triangle_object[t].index()] == object)
        return scene.material_of(t).name;
    return "no object " + object;
  }
  static bool is_warned(const VariantPlan& plan, const std::string& words) {
    return std::ranges::any_of(plan.built.warnings, [&](const std::string& warning) {
      return warning.find(words) != std::string::npos;
    });
  }

  WorkFolder folder_;
};

TEST_F(Rules, ByKindLeaveAFileTheMaterialOfItsOwn) {
  const VariantPlan plan = this->plan("{surface: wall, material: brick}");
  EXPECT_EQ(material_of(plan, "wall"), "brick");
  EXPECT_EQ(material_of(plan, "crown"), "leaves");
  ASSERT_EQ(plan.built.rules.size(), 1u);
  const RuleUse& use = plan.built.rules.front();
  EXPECT_EQ(use.rule, "surface wall: brick");
  EXPECT_EQ(use.matched, 4u);
  EXPECT_EQ(use.given, 2u);
  EXPECT_NEAR(use.given_m2, 12, 1e-9);
  EXPECT_TRUE(is_warned(plan, "'brick' matches everything"));
}

TEST_F(Rules, ThatNameSomethingGoBeforeThoseByKindWhateverTheirOrder) {
  const VariantPlan plan = this->plan(
      "{object: \"cr*\", material: snow}, {surface: wall, material: brick}, {object: \"*\", "
      "material: leaves}");
  EXPECT_EQ(material_of(plan, "crown"), "snow");
  // A pattern of everything names nothing: the last by kind.
  EXPECT_EQ(material_of(plan, "wall"), "leaves");
  EXPECT_TRUE(is_warned(plan, "'brick' gives nothing"));
  EXPECT_FALSE(is_warned(plan, "'snow'"));
}

TEST_F(Rules, OfOneRankTheLastWins) {
  const VariantPlan plan = this->plan(
      "{object: wall, material: brick}, {object: \"w*\", surface: wall, material: snow}");
  EXPECT_EQ(material_of(plan, "wall"), "snow");
  EXPECT_TRUE(is_warned(plan, "'brick' gives nothing"));
  EXPECT_TRUE(is_warned(this->plan("{object: house, material: brick}"), "'brick' matches nothing"));
}

TEST_F(Rules, NamesOfTheTableThatFilesLeaveWithoutAValueAreTold) {
  const auto told = [&](const std::string& material) {
    folder_.write("wall.obj", "usemtl " + material + "\n" + wall_and_crown);
    return is_warned(plan("{object: crown, material: leaves}"),
                     "files name materials of the table without a value (" + material +
                         " 12 m2) (they reflect 0.2 as what nobody defines" +
                         (material == "wood" ? ")" : ", and no light passes)") +
                         "; scene.materials: {" + material + ": {}} takes the table's");
  };
  EXPECT_TRUE(told("crown_bare"));
  EXPECT_TRUE(told("wood"));
  EXPECT_FALSE(told("brick"));  // of the study
  folder_.write("wall.obj", std::string("usemtl wall_7\n") + wall_and_crown);
  EXPECT_FALSE(
      is_warned(plan("{object: crown, material: leaves}"), "files name materials of the table"));
}

}  // namespace
}  // namespace sunload::test
