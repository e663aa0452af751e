// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Materials that a study defines and nothing uses, and measures of what no surface is.
#include "io/plan/material_uses.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "io/plan/planner.h"
#include "tests/support/work_folder.h"

namespace sunload::test {
namespace {

class MaterialUse : public testing::Test {
 protected:
  /// Warnings with `words` of each variant of a study of a box of plaster.
  std::vector<std::string> warned(const std::string& materials, const std::string& more,
                                  const std::string& words = "is used by nothing") {
    const StudyFile file = read_study(folder_.write(
        "s.yaml",
        "format: sunload-study-1\nname: s\nsite: {timezone: UTC, latitude_deg: 50, longitude_deg: "
        "14}\nperiod: {days: [2026-03-21]}\nmesh: {oracle: none}\nscene:\n  builtin: {name: "
        "box_on_plane}\n  ground: {surface: none, material: grass}\n  materials: {" +
            materials +
            "}\n  edit:\n    - {object: box, remove: true}\n    - {add: {name: house, material: "
            "plaster, box: {position_m: [0, 0, 0], size_m: [10, 10, 8]}}}\n" +
            more));
    Planner planner;
    MaterialUses uses(file, planner);
    std::vector<std::string> found;
    for (const Study& study : file.variants) {
      VariantPlan plan = planner.plan(study);
      uses.warn_of_idle(plan);
      for (const std::string& warning : plan.built.warnings)
        if (warning.find(words) != warning.npos) found.push_back(study.variant + ": " + warning);
    }
    return found;
  }
  WorkFolder folder_;
};

TEST_F(MaterialUse, WarnsOfSlipsInEveryVariantThatHasThem) {
  const auto all = warned("", "matrix: {\"scene.materials.plastr.diffuse\": [0.2, 0.7]}\n");
  ASSERT_EQ(all.size(), 2u);
  EXPECT_NE(all[0].find("material 'plastr' is used by nothing"), all[0].npos) << all[0];
  EXPECT_NE(all[0].find("did you mean 'plaster'?"), all[0].npos) << all[0];
  EXPECT_NE(all[0].find("s.yaml:13:"), all[0].npos) << all[0];
  const auto of_one = warned(
      "", "variants: [{name: a, scene: {materials: {plasta: {diffuse: 0.9}}}}, {name: b}]\n");
  ASSERT_EQ(of_one.size(), 1u);
  EXPECT_TRUE(of_one[0].starts_with("a: "));
}

TEST_F(MaterialUse, IsOfParallelSources) {
  folder_.write("lamp.obj", "v -1 -1 9\nv 1 -1 9\nv 1 1 9\no sheet\nusemtl beam\nf 1 3 2\n");
  const auto all = warned("beam: {diffuse: 0, emission_w_m2: 500}, bean: {diffuse: 0.1}",
                          "  parallel_sources: lamp.obj\n");
  ASSERT_EQ(all.size(), 1u);
  EXPECT_NE(all[0].find("material 'bean' is used by nothing"), all[0].npos) << all[0];
}

TEST_F(MaterialUse, IsOfFacesRulesSeasonsAndGround) {
  using None = std::vector<std::string>;
  EXPECT_EQ(warned("plaster: {diffuse: 0.4}, grass: {diffuse: 0.2}", ""), None{});
  EXPECT_EQ(warned("paint: {diffuse: 0.4}", "  assign: [{surface: roof, material: paint}]\n"),
            None{});
  EXPECT_EQ(warned("plaster: {diffuse: 0.4, seasons: {winter: white}}, white: {diffuse: 0.8}",
                   "seasons: {winter: [12, 1, 2]}\n"),
            None{});
  EXPECT_EQ(warned("white: {diffuse: 0.8}", "").size(), 1u);
}

TEST_F(MaterialUse, OfOneVariantIsEnough) {
  EXPECT_EQ(warned("slate: {diffuse: 0.1}",
                   "variants:\n  - {name: a}\n  - {name: b, scene: {edit: [{add: {name: shed, "
                   "material: slate, box: {position_m: [30, 0, 0], size_m: [4, 4, 3]}}}]}}\n"),
            std::vector<std::string>{});
}

TEST_F(MaterialUse, MeasuresOfNoSurfaceAreWarnedOf) {
  const auto of = [&](const std::string& keys) {
    return warned("", "measures: {m: {rule: bre_209_vsc, of: {" + keys + "}}}\n", "measure m");
  };
  const auto none = of("facade: 'house/s*', surface: roof");
  ASSERT_EQ(none.size(), 1u);
  EXPECT_NE(none[0].find("no surface of variant baseline is of facade 'house/s*' and surface "
                         "'roof'"),
            none[0].npos)
      << none[0];
  EXPECT_TRUE(of("facade: 'house/s*', surface: wall").empty());
  EXPECT_TRUE(of("object: house, surface: roof").empty());
}

}  // namespace
}  // namespace sunload::test
