// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// VRML colours that reflect more than arrives: refused with their files, or scaled and told.
#include <gtest/gtest.h>

#include "io/plan/scene_build.h"
#include "tests/support/refusal_of.h"
#include "tests/support/work_folder.h"

namespace sunload {
namespace {

class VrmlExcess : public testing::Test {
 protected:
  static std::string shape(const std::string& name, const std::string& colours) {
    return "Shape { appearance Appearance { material DEF " + name + " Material { " + colours +
           " } } geometry Box { } }\n";
  }

  VrmlExcess() {
    const std::string head = "#VRML V2.0 utf8\n";
    folder.write("inner.wrl", head + shape("tin", "diffuseColor .9 .9 .9 specularColor .6 .6 .6"));
    folder.write("outer.wrl",
                 head + "Inline { url \"inner.wrl\" }\nTransform { translation 5 0 0 children " +
                     shape("pink", "diffuseColor 1 .8 .6 specularColor .8 .8 .8") + "}\n" +
                     "Transform { translation 9 0 0 children " +
                     shape("dull", "diffuseColor .5 .5 .5 specularColor .3 .3 .3") + "}\n");
  }

  BuiltScene built(const std::string& scene, const std::string& solver = "{}") const {
    return build_scene(read_study(folder.write("study.yaml",
                                               "format: sunload-study-1\n"
                                               "name: excess\n"
                                               "site: {latitude_deg: 50, longitude_deg: 14, "
                                               "timezone: UTC}\n"
                                               "period: {days: [2026-03-21]}\n"
                                               "light: {source: clear_sky}\n"
                                               "scene: {files: [outer.wrl]" +
                                                   scene + "}\nsolver: " + solver + "\n"))
                           .variants.front());
  }

  static const Material& material(const BuiltScene& scene, const std::string& name) {
    const auto& all = scene.scene.materials;
    return *std::find_if(all.begin(), all.end(), [&](const auto& m) { return m.name == name; });
  }

  const test::WorkFolder folder;
};

TEST_F(VrmlExcess, AllAreRefusedAtOnceWithTheirFiles) {
  const auto said = test::refusal_of([&] { built(""); });
  for (const char* part : {"inner.wrl: material 'tin'", "outer.wrl: material 'pink'",
                           "write scene.vrml_excess: scale"})
    EXPECT_NE(said.find(part), std::string::npos) << part << "\nis missing in\n" << said;
  EXPECT_EQ(said.find("dull"), std::string::npos) << said;
}

TEST_F(VrmlExcess, OfOneNameInSeveralFilesEachIsRefused) {
  for (const char* file : {"a.wrl", "b.wrl"})
    folder.write(file, "#VRML V2.0 utf8\n" + shape("tin",
                                                   "diffuseColor .9 .9 .9 specularColor "
                                                   ".6 .6 .6"));
  const auto said = test::refusal_of([&] {
    build_scene(read_study(folder.write("study.yaml",
                                        "format: sunload-study-1\nname: excess\n"
                                        "site: {latitude_deg: 50, longitude_deg: 14, timezone: "
                                        "UTC}\nperiod: {days: [2026-03-21]}\n"
                                        "light: {source: clear_sky}\nscene: {files: [a.wrl, "
                                        "{file: b.wrl, position_m: [5, 0, 0]}]}\n"))
                    .variants.front());
  });
  for (const char* part : {"a.wrl: material 'tin'", "b.wrl: material 'tin'"})
    EXPECT_NE(said.find(part), std::string::npos) << part << "\nis missing in\n" << said;
}

TEST_F(VrmlExcess, ScaledByTheirRatioAndTold) {
  const auto scene = built(", vrml_excess: scale");
  EXPECT_NEAR(material(scene, "tin").diffuse, 0.6, 1e-6);
  EXPECT_NEAR(material(scene, "tin").mirror, 0.4, 1e-6);
  EXPECT_NEAR(material(scene, "pink").diffuse, 0.5, 1e-6);
  EXPECT_NEAR(material(scene, "dull").diffuse, 0.5, 1e-6);
  ASSERT_FALSE(scene.warnings.empty());
  std::string told;
  for (const auto& warning : scene.warnings) told += warning;
  EXPECT_NE(told.find("2 materials"), std::string::npos) << told;
  EXPECT_NE(told.find("'tin' of "), std::string::npos) << told;
  EXPECT_NE(told.find("inner.wrl × 0.667"), std::string::npos) << told;
}

TEST_F(VrmlExcess, InBandsTheBrightestIsTheMeasure) {
  const auto scene = built(", vrml_excess: scale", "{bands: rgb}");
  const Material& pink = material(scene, "pink");
  ASSERT_TRUE(pink.diffuse_in_band);
  EXPECT_NEAR((*pink.diffuse_in_band)[0] + pink.mirror, 1, 1e-6);
  EXPECT_NEAR((*pink.diffuse_in_band)[2] / (*pink.diffuse_in_band)[0], 0.6, 1e-6);
}

TEST_F(VrmlExcess, MaterialsOfTheStudyAreNotScaled) {
  const auto said = test::refusal_of(
      [&] { built(", vrml_excess: scale, materials: {tin: {diffuse: 0.9, mirror: 0.6}}"); });
  EXPECT_NE(said.find("tin"), std::string::npos) << said;
}

}  // namespace
}  // namespace sunload
