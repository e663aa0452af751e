// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Materials that studies name without defining them: the table, its page, and what a name means.

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "io/plan/material_assign.h"
#include "io/plan/variant_plan.h"
#include "io/study/material_table.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"

namespace sunload::test {
namespace {

TEST(MaterialTable, RowsAreSourcedAndPossible) {
  std::set<std::string> names;
  std::string last;
  for (const auto& row : material_table()) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_LT(last, row.name) << "in alphabetical order";
    last = row.name;
    EXPECT_NE(std::string(row.what), "");
    const std::string source = row.source;
    const bool has_year = source.find("(19") != source.npos || source.find("(20") != source.npos;
    EXPECT_TRUE(has_year || source.starts_with("Lecture")) << row.name;
    EXPECT_LE(row.low, row.high) << row.name;
    EXPECT_GE(row.low, 0) << row.name;
    EXPECT_LE(row.diffuse() + row.mirror + row.transmittance, 1) << row.name;
    EXPECT_TRUE(row.diffuse() > 0 || row.refractive_index > 1) << row.name;
    const auto as_study = tabled_material(row.name);
    ASSERT_TRUE(as_study) << row.name;
    EXPECT_EQ(as_study->diffuse, row.diffuse());
  }
  EXPECT_FALSE(tabled_material("unobtainium"));
  for (const char* name : {"brick", "concrete", "asphalt", "grass", "snow_fresh", "snow_old",
                           "soil", "sand", "water", "glass", "limestone", "plaster", "wood",
                           "steel", "aluminium", "roof_tile", "bitumen", "gravel", "crown"})
    EXPECT_TRUE(names.contains(name)) << name;
}

TEST(MaterialTable, HasTheLecturesValues) {
  const std::map<std::string, double> lecture{
      {"snow_fresh", 0.80}, {"snow_old", 0.40}, {"soil", 0.15}};
  for (const auto& [name, value] : lecture) EXPECT_EQ(tabled_material(name)->diffuse, value);
}

/// The row of a listing that begins so, as numbers.
std::vector<double> shares_of(const std::string& listing, const std::string& name) {
  const auto at = listing.find("\n" + name);
  if (at == std::string::npos) return {};
  std::istringstream row(listing.substr(at + 1 + name.size(), listing.find('\n', at + 1) - at));
  std::vector<double> shares;
  for (double share = 0; row >> share && shares.size() < 7;) shares.push_back(share);
  return shares;
}

TEST(MaterialTable, TellsReflectancesByAngle) {
  const std::string listing = angle_listing();
  constexpr double printed = 5.1e-4;  // three digits
  const auto brick = shares_of(listing, "brick, reflected");
  ASSERT_EQ(brick.size(), 7u);
  for (const double share : brick)
    EXPECT_NEAR(share, tabled_material("brick")->diffuse.value(), printed);
  EXPECT_TRUE(shares_of(listing, "brick, passed").empty());
  // A pane: more and more of slanting light, and energy is kept.
  const auto reflected = shares_of(listing, "glass, reflected");
  const auto passed = shares_of(listing, "glass, passed");
  ASSERT_EQ(reflected.size(), 7u);
  ASSERT_EQ(passed.size(), 7u);
  EXPECT_TRUE(std::is_sorted(reflected.begin(), reflected.end()));
  EXPECT_GT(reflected.back(), 4 * reflected.front());
  for (std::size_t i = 0; i < 7; ++i) EXPECT_LE(reflected[i] + passed[i], 1 + 2 * printed);
}

TEST(MaterialTable, ACrownPassesWhatWasMeasuredThroughTwoSurfaces) {
  for (const auto& [name, whole] : {std::pair{"crown", 0.03}, {"crown_bare", 0.46}}) {
    const double skin = tabled_material(name)->transmittance;
    EXPECT_NEAR(skin * skin, whole, 0.0005) << name;  // three digits are written
  }
}

TEST(MaterialTable, PageIsWrittenFromIt) {
  std::ifstream file(test::source_folder() + "/docs/materials.md");
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_EQ(text.str(), material_page()) << "run sunload materials --markdown > docs/materials.md";
}

/// Books and papers that were not at hand when their values were written down.
TEST(MaterialTable, SourcesThatWereNotReadAreMarked) {
  for (const auto& row : material_table()) {
    const std::string source = row.source;
    bool is_quoted = false;
    for (const char* name : {"Oke", "Hunn", "Incropera", "Duffie", "Konarska"})
      is_quoted = is_quoted || source.find(name) != source.npos;
    EXPECT_EQ(source.ends_with(" *"), is_quoted) << row.name;
  }
  EXPECT_NE(material_page().find("were not compared with it"), std::string::npos);
  EXPECT_NE(material_listing().find("\n* from memory, not compared"), std::string::npos);
}

/// A floor of 4 m x 4 m, and 1 m x 4 m beside it whose material the file leaves open.
class Names : public testing::Test {
 protected:
  Names() {
    folder_.write(
        "plates.mtl",
        "newmtl m\nKd 0.5 0.5 0.5\nnewmtl brick\nnewmtl lamp\nKd 0.1 0.1 0.1\nKe 1 1 1\n");
    folder_.write(
        "plates.obj",
        "mtllib plates.mtl\no plate\nusemtl m\nv 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nf 1 2 3 4\n"
        "o strip\nusemtl brick\nv 5 0 0\nv 6 0 0\nv 6 4 0\nv 5 4 0\nf 5 6 7 8\n");
    folder_.write("lamp.obj",
                  "mtllib plates.mtl\no lamp\nusemtl lamp\nv 0 0 1\nv 4 0 1\nv 4 4 1\nf 1 2 3\n");
  }

  VariantPlan plan(const std::string& scene) const {
    return make_plan(
        read_study(folder_.write("s.yaml",
                                 "format: sunload-study-1\nname: s\nsite: {timezone: UTC}\n"
                                 "period: {positions: [{azimuth_deg: 180, elevation_deg: 45}]}\n"
                                 "light: {source: fixed, dni_w_m2: 100, dhi_w_m2: 10}\n"
                                 "scene: {" +
                                     scene + "}\n"))
            .variants.front());
  }
  static const Material& of(const VariantPlan& plan, const std::string& object) {
    const auto& mesh = plan.built.scene.mesh;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
      if (mesh.object_names[mesh.triangle_object[t].index()] == object)
        return plan.built.scene.materials[plan.built.scene.material[t].index()];
    throw std::logic_error("no object " + object);
  }
  static std::string warnings(const VariantPlan& plan) {
    std::string all;
    for (const auto& line : plan.built.warnings) all += line + "\n";
    return all;
  }
  std::string refusal(const std::string& scene) const {
    try {
      plan(scene);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }

  WorkFolder folder_;
};

TEST_F(Names, MeanTheTablesRowsWhereNobodyDefinesThem) {
  const auto asphalt = plan("files: [plates.obj], assign: [{object: plate, material: asphalt}]");
  EXPECT_EQ(of(asphalt, "plate").diffuse, 0.125);
  EXPECT_EQ(of(asphalt, "plate").name, "asphalt");
  const auto glass = plan("files: [plates.obj], assign: [{object: plate, material: glass}]");
  EXPECT_EQ(std::get<Panes>(of(glass, "plate").smooth).refractive_index, 1.526);
  const auto crown = plan("files: [plates.obj], assign: [{object: plate, material: crown}]");
  EXPECT_EQ(crown.built.scene.mesh.triangle_sides[0], Sides::two);
  const auto ground = plan("files: [plates.obj], ground: {margin_m: 1, material: grass}");
  EXPECT_EQ(of(ground, "ground").diffuse, 0.21);
  const auto file = plan("files: [{file: plates.obj, material: slate}]");
  EXPECT_EQ(of(file, "plate").diffuse, 0.1);
  EXPECT_EQ(of(file, "strip").diffuse, 0.1);
}

TEST_F(Names, OfTheStudyAndOfFilesGoFirst) {
  const std::string rule = "files: [plates.obj], assign: [{object: plate, material: brick}]";
  // The file has a brick, but says nothing of it: the table does.
  EXPECT_EQ(of(plan(rule), "plate").diffuse, 0.3);
  EXPECT_EQ(of(plan(rule + ", materials: {brick: {diffuse: 0.4}}"), "plate").diffuse, 0.4);
  EXPECT_EQ(of(plan(rule + ", materials: {brick: {mirror: 0.4}}"), "plate").diffuse, 0);
  EXPECT_EQ(of(plan(rule + ", materials: {brick: {sides: two}}"), "plate").diffuse, 0.3);
  EXPECT_EQ(
      of(plan("files: [plates.obj], assign: [{object: strip, material: m}]"), "strip").diffuse,
      0.5);
}

TEST_F(Names, OfClearGlassTakeNothingFromTheTable) {
  const std::string rule = "files: [plates.obj], assign: [{object: strip, material: glass}], ";
  const auto clear = plan(rule + "materials: {glass: {normal_transmittance: 0.8, mirror: 0.1}}");
  const Material& glass = of(clear, "strip");
  EXPECT_EQ(glass.smooth, Smooth(ClearGlass{0.8}));
  EXPECT_EQ(glass.mirror, 0.1);
  EXPECT_EQ(glass.diffuse, 0);
  const auto darker = plan(rule + "materials: {glass: {normal_transmittance: 0.7, mirror: 0.1}}");
  EXPECT_NE(clear.content_hash, darker.content_hash);
  // What the file says of reflection holds for glass, too, where the study is silent.
  const std::string text =
      refusal("files: [plates.obj], materials: {m: {normal_transmittance: 0.5}}");
  EXPECT_NE(text.find("diffuse 0.5 + mirror 0 + 1.018 normal_transmittance 0.5 exceeds 1"),
            std::string::npos)
      << text;
  EXPECT_EQ(of(plan("files: [plates.obj], materials: {m: {normal_transmittance: 0.9, diffuse: 0}}"),
               "plate")
                .smooth,
            Smooth(ClearGlass{0.9}));
}

TEST_F(Names, OfFilesAloneAreNotLookedUp) {
  const auto left = plan("files: [plates.obj]");
  EXPECT_EQ(of(left, "strip").diffuse, default_reflectance);
  EXPECT_NE(warnings(left).find(
                "4 m2, 20 % of the surface, have no material in file or study (other 4 m2)"),
            std::string::npos)
      << warnings(left);
  const auto named = plan("files: [plates.obj], materials: {brick: {}}");
  EXPECT_EQ(of(named, "strip").diffuse, 0.3);
  EXPECT_EQ(warnings(named).find("no material"), std::string::npos);
  EXPECT_NE(left.content_hash, named.content_hash);
}

TEST_F(Names, ThatNobodyKnowsAreRefusedWithTheNearest) {
  const std::string text =
      refusal("files: [plates.obj], assign: [{object: plate, material: asfalt}]");
  EXPECT_NE(text.find("material 'asfalt' is not known"), std::string::npos) << text;
  EXPECT_NE(text.find("did you mean 'asphalt'?"), std::string::npos) << text;
  EXPECT_NE(
      refusal("files: [plates.obj], ground: {material: unobtainium}").find("sunload materials"),
      std::string::npos);
}

TEST_F(Names, OfMaterialsThatGlowAskForTheirPower) {
  const auto dark = plan("files: [plates.obj, lamp.obj]");
  EXPECT_NE(warnings(dark).find("material 'lamp' glows by its file"), std::string::npos)
      << warnings(dark);
  const auto lit = plan("files: [plates.obj, lamp.obj], materials: {lamp: {emission_w_m2: 5}}");
  EXPECT_EQ(warnings(lit).find("glows"), std::string::npos);
  EXPECT_EQ(of(lit, "lamp").emission_w_m2, 5);
  EXPECT_DOUBLE_EQ(of(lit, "lamp").diffuse, 0.1);  // mean of three
}

}  // namespace
}  // namespace sunload::test
