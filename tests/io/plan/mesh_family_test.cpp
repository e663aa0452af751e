// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Variants of one geometry have one mesh, which the pilots of all of them refine.

#include "io/plan/mesh_family.h"

#include <gtest/gtest.h>

#include "io/plan/planner.h"
#include "tests/support/work_folder.h"

namespace sunload::test {
namespace {

/// A court with a mirror for a wall in some of its variants.
constexpr const char* court =
    "o plain\nusemtl land\nv -20 -20 0\nv 20 -20 0\nv 20 20 0\nv -20 20 0\nf 1 2 3 4\n"
    "o house\nusemtl wall\nv -10 19 0\nv 10 19 0\nv 10 19 8\nv -10 19 8\nf 5 6 7 8\n";

class Family : public testing::Test {
 protected:
  Family() { folder_.write("court.obj", court); }
  StudyFile study(const std::string& variants) const {
    return read_study(folder_.write(
        "s.yaml",
        "format: sunload-study-1\nname: s\nsite: {latitude_deg: 50, longitude_deg: 14, timezone: "
        "UTC}\nperiod: {days: [2026-03-21], from: \"10:00\", to: \"14:00\", step_min: 60}\n"
        "light: {source: clear_sky}\n"
        "scene: {files: [court.obj], materials: {land: {diffuse: 0.2}, wall: {diffuse: 0.3}}}\n" +
            variants));
  }
  std::vector<VariantPlan> plans(const std::string& variants) const {
    const StudyFile file = study(variants);
    Planner planner;
    const MeshFamilies families(file, planner);
    std::vector<VariantPlan> made;
    for (const Study& each : file.variants) {
      made.push_back(planner.plan(each));
      families.join(made.back());
    }
    return made;
  }
  static std::vector<std::uint64_t> patches(const VariantPlan& plan) {
    Watch watch;
    return make_mesh(plan, watch).mesh->key();
  }
  WorkFolder folder_;
};

constexpr const char* dull = "{name: dull}";
constexpr const char* dark = "{name: dark, scene: {materials: {wall: {diffuse: 0.1}}}}";
constexpr const char* mirror =
    "{name: mirror, scene: {materials: {wall: {diffuse: 0.1, mirror: 0.8}}}}";

std::string list(std::initializer_list<const char*> variants) {
  std::string text = "variants:\n";
  for (const char* variant : variants) text += std::string("  - ") + variant + "\n";
  return text;
}

TEST_F(Family, HasOneMeshForItsMirrorsAndWithoutThem) {
  const auto both = plans(list({dull, mirror}));
  ASSERT_TRUE(both[0].family && both[1].family);
  EXPECT_EQ(both[0].family->pilots.size(), 2u);
  EXPECT_EQ(patches(both[0]), patches(both[1]));
  // Alone, the mirror's image is nothing that the dull one has.
  const auto one = plans(list({dull})), other = plans(list({mirror}));
  EXPECT_LT(patches(one[0]).size(), patches(other[0]).size());
  EXPECT_GE(patches(both[0]).size(), patches(other[0]).size());
}

TEST_F(Family, DecidesTheHashOfEachByAllThatRefineTheMesh) {
  const auto alone = plans(list({dull})), both = plans(list({dull, mirror})),
             turned = plans(list({mirror, dull}));
  EXPECT_NE(alone[0].content_hash, both[0].content_hash);
  EXPECT_EQ(both[0].content_hash, turned[1].content_hash);
  EXPECT_EQ(both[1].content_hash, turned[0].content_hash);
}

/// Diffuse reflectances are grey to the pilot: hash and mesh are those of the variant alone.
TEST_F(Family, OfDiffuseMaterialsChangesNothing) {
  const auto alone = plans(list({dull})), both = plans(list({dull, dark}));
  ASSERT_TRUE(both[0].family);
  EXPECT_EQ(both[0].family->pilots.size(), 1u);
  EXPECT_EQ(alone[0].content_hash, both[0].content_hash);
  EXPECT_EQ(patches(alone[0]), patches(both[1]));
}

TEST_F(Family, IsOfOneGeometryAndOneSetOfRulesOnly) {
  const auto apart =
      plans(list({dull, "{name: finer, mesh: {light_tolerance: 0.05}}",
                  "{name: bare, scene: {files: [{file: court.obj, position_m: [0, 0, 1]}]}}"}));
  for (const auto& plan : apart) EXPECT_FALSE(plan.family) << plan.study.variant;
}

TEST_F(Family, TakesNoMorePilotsThanItMay) {
  std::string variants = "variants:\n";
  for (int v = 0; v < 11; ++v)
    variants += "  - {name: v" + std::to_string(v) +
                ", scene: {materials: {wall: {diffuse: 0.1, "
                "mirror: 0." +
                std::to_string(50 + v) + "}}}}\n";
  const auto many = plans(variants);
  ASSERT_TRUE(many[0].family);
  EXPECT_EQ(many[0].family->pilots.size(), most_mesh_pilots);
  EXPECT_EQ(many[0].family, many[10].family);
}

}  // namespace
}  // namespace sunload::test
