// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Buildings chosen with what belongs to them: by steps, rules, selections and measures.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "geo/edit/objects.h"
#include "io/plan/content_hash.h"
#include "io/plan/scene_build.h"
#include "io/plan/scene_edit.h"
#include "io/plan/scene_models.h"
#include "io/plan/study_measures.h"
#include "io/plan/variant_mesh.h"
#include "io/plan/variant_plan.h"
#include "tests/support/family_town.h"
#include "tests/support/refusal_of.h"
#include "tests/support/work_folder.h"

namespace sunload::test {
namespace {

class Families : public testing::Test {
 protected:
  Families() { folder_.write("town.city.json", family_town()); }

  Study study(const std::string& scene, const std::string& more = "") const {
    return read_study(folder_.write("s.yaml",
                                    "format: sunload-study-1\nname: s\nsite: {timezone: UTC, "
                                    "latitude_deg: 50, longitude_deg: 14}\nperiod: {days: "
                                    "[2026-03-21]}\nmesh: {oracle: none}\nscene: {files: "
                                    "[town.city.json], ground: {surface: none}, materials: {red: "
                                    "{diffuse: 0.3}}, " +
                                        scene + "}\n" + more))
        .variants.front();
  }
  PolygonModel model(const std::string& steps, const std::string& more = "") const {
    const Study with_steps = study("edit: [" + steps + "]", more);
    return edited(read_models(with_steps), with_steps).model;
  }
  std::string refusal(const std::string& steps) const {
    return refusal_of([&] { model(steps); });
  }

  /// Lowest and highest z of each object.
  using Heights = std::map<std::string, std::pair<double, double>>;
  static Heights heights(const PolygonModel& model) {
    Heights all;
    const auto extents = extents_of(model);
    for (std::size_t o = 0; o < extents.size(); ++o)
      all[model.object_names[o]] = {extents[o].box.low.z, extents[o].box.high.z};
    return all;
  }
  static Heights as_read() {
    return {{"house", {0, 6}},    {"dormer", {6, 7}},     {"steps", {0, 1}},     {"mast", {3, 8}},
            {"hall_low", {0, 6}}, {"hall_high", {0, 12}}, {"chimney", {12, 14}}, {"shed", {0, 3}}};
  }
  using Names = std::set<std::string>;
  /// What is gone after a step that removes.
  Names removed_by(const std::string& choice, const std::string& more = "") const {
    const auto left = heights(model("{" + choice + ", remove: true}", more));
    Names gone;
    for (const auto& [name, range] : as_read())
      if (!left.contains(name)) gone.insert(name);
    return gone;
  }
  /// Objects that a rule gives its material.
  Names painted_by(const std::string& rule, const std::string& more = "") const {
    const BuiltScene built = build_scene(study("assign: [{" + rule + ", material: red}]", more));
    const Mesh& mesh = built.scene.mesh;
    Names names;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
      if (built.scene.material_of(t).name == "red")
        names.insert(mesh.object_names[mesh.triangle_object[t].index()]);
    return names;
  }
  WorkFolder folder_;

  const Names of_house_{"house", "dormer", "steps", "mast"};
  const Names of_hall_{"hall_low", "hall_high", "chimney"};
};

/// Cellars and storeys: what is above them is raised, and windows stay where they are.
TEST_F(Families, APartThatAnotherCoversStays) {
  const std::string part = R"("parents":["house"])";
  folder_.write("town.city.json",
                FamilyTown()
                    .add_bare("house", "Building", R"("children":["cellar","storey","top","lift"])")
                    .add("cellar", "BuildingPart", part, {0, 0, -3}, {20, 12, 0})
                    .add("storey", "BuildingPart", part, {0, 0, 0}, {20, 12, 4})
                    .add("top", "BuildingPart", part, {0, 0, 4}, {20, 12, 12})
                    .add("lift", "BuildingPart", part, {4, 4, 12}, {8, 8, 15})
                    .text());
  EXPECT_EQ(
      heights(model("{object: house, raise: {by_m: 3}}")),
      (Heights{{"cellar", {-3, 0}}, {"storey", {0, 4}}, {"top", {4, 15}}, {"lift", {15, 18}}}));
}

TEST_F(Families, APartThatEndsBelowFromMCarriesNone) {
  const std::string part = R"("parents":["house"])";
  folder_.write("town.city.json",
                FamilyTown()
                    .add_bare("house", "Building", R"("children":["podium","tower","wing"])")
                    .add("podium", "BuildingPart", part, {0, 0, 0}, {40, 30, 5})
                    .add("tower", "BuildingPart", part, {5, 5, 5}, {15, 15, 35})
                    .add("wing", "BuildingPart", part, {40, 0, 0}, {50, 30, 20})
                    .text());
  EXPECT_EQ(heights(model("{object: house, raise: {by_m: 3, from_m: 10}}")),
            (Heights{{"podium", {0, 5}}, {"tower", {5, 38}}, {"wing", {0, 23}}}));
}

TEST_F(Families, APartOnTheRoofOfAHouseOfItsOwnShapeRisesWithIt) {
  folder_.write("town.city.json",
                FamilyTown()
                    .add("house", "Building", R"("children":["tower"])", {0, 0, 0}, {20, 12, 10})
                    .add("tower", "BuildingPart", R"("parents":["house"])", {4, 4, 10}, {8, 8, 13})
                    .text());
  EXPECT_EQ(heights(model("{object: house, raise: {by_m: -1}}")),
            (Heights{{"house", {0, 9}}, {"tower", {9, 12}}}));
}

TEST_F(Families, PartsThatStandOnAPartRiseWithIt) {
  const auto part = [](const char* of) { return std::string(R"("parents":[")") + of + R"("])"; };
  folder_.write("town.city.json",
                FamilyTown()
                    .add_bare("house", "Building", R"("children":["main","wing","tower","top"])")
                    .add("main", "BuildingPart", part("house"), {0, 0, 0}, {20, 12, 10})
                    .add("wing", "BuildingPart", part("house"), {20, 0, 0}, {26, 12, 6})
                    .add("tower", "BuildingPart", part("house"), {4, 4, 10}, {8, 8, 13})
                    .add("top", "BuildingPart", part("house"), {5, 5, 13}, {6, 6, 14})
                    .text());
  const auto by = [&](const std::string& by_m) {
    return heights(model("{object: house, raise: {by_m: " + by_m + "}}"));
  };
  EXPECT_EQ(by("3"),
            (Heights{{"main", {0, 13}}, {"wing", {0, 9}}, {"tower", {13, 16}}, {"top", {16, 17}}}));
  EXPECT_EQ(by("-4"),
            (Heights{{"main", {0, 6}}, {"wing", {0, 2}}, {"tower", {6, 9}}, {"top", {9, 10}}}));
  // By itself a part is a body.
  EXPECT_EQ(heights(model("{object: tower, raise: {by_m: 2}}"))["tower"],
            (std::pair<double, double>{10, 15}));
}

/// A tower drawn into its podium, whose foot stays in there, and one across the joint of two parts.
TEST_F(Families, PartsThatStandInARoofOrOnTwoRiseWithThem) {
  const std::string part = R"("parents":["house"])";
  folder_.write(
      "town.city.json",
      FamilyTown()
          .add_bare("house", "Building", R"("children":["west","east","sunk","across","yard"])")
          .add("west", "BuildingPart", part, {0, 0, 0}, {20, 12, 10})
          .add("east", "BuildingPart", part, {20, 0, 0}, {40, 12, 10})
          .add("sunk", "BuildingPart", part, {4, 4, 9.5}, {8, 8, 13})
          .add("across", "BuildingPart", part, {18, 3, 10}, {22, 9, 14})
          .add("yard", "BuildingPart", part, {0, 12, 0}, {10, 20, 3})
          .text());
  EXPECT_EQ(heights(model("{object: house, raise: {by_m: 3}}")), (Heights{{"west", {0, 13}},
                                                                          {"east", {0, 13}},
                                                                          {"sunk", {9.5, 16}},
                                                                          {"across", {13, 17}},
                                                                          {"yard", {0, 6}}}));
}

TEST_F(Families, RiseWithWhatSitsOnThem) {
  Heights raised = as_read();
  raised["house"] = {0, 9};
  raised["dormer"] = {9, 10};
  raised["mast"] = {3, 11};  // along the wall: its foot stays
  const PolygonModel made = model("{object: house, raise: {by_m: 3}}");
  EXPECT_EQ(heights(made), raised);
  EXPECT_EQ(made.notes.back(),
            "scene.edit[1]: raises by 3 m 3 objects: dormer, house, mast (cut at z = 6 m)");
}

TEST_F(Families, PartsRiseAsBuildings) {
  Heights raised = as_read();
  raised["hall_low"] = {0, 9};
  raised["hall_high"] = {0, 15};
  raised["chimney"] = {15, 17};
  EXPECT_EQ(heights(model("{object: hall, raise: {by_m: 3}}")), raised);
  raised["hall_low"] = {0, 6};  // ends below
  EXPECT_EQ(heights(model("{object: hall, raise: {by_m: 3, from_m: 8}}")), raised);
  const std::string said = refusal("{object: hall, raise: {by_m: 3, from_m: 20}}");
  EXPECT_NE(said.find("hall_low ends below from_m"), said.npos) << said;
}

TEST_F(Families, RiseOnceWhateverMatches) {
  Heights raised = as_read();
  for (const char* name : {"house", "mast", "hall_low", "hall_high", "shed"})
    raised[name].second += 3;
  for (const char* name : {"dormer", "chimney"})
    raised[name] = {raised[name].first + 3, raised[name].second + 3};
  EXPECT_EQ(heights(model("{object: '*', raise: {by_m: 3}}")), raised);
  EXPECT_EQ(heights(model("{type: Building, raise: {by_m: 3}}")), raised);
}

TEST_F(Families, MembersAreChosenAlone) {
  Heights raised = as_read();
  raised["dormer"] = {6, 8};
  EXPECT_EQ(heights(model("{object: dormer, raise: {by_m: 1}}")), raised);
  EXPECT_EQ(removed_by("object: dormer"), Names{"dormer"});
  EXPECT_EQ(removed_by("type: BuildingInstallation"),
            (Names{"dormer", "steps", "mast", "chimney"}));
  EXPECT_EQ(removed_by("object: house, type: BuildingInstallation"),
            (Names{"dormer", "steps", "mast"}));
}

TEST_F(Families, GoMoveAndTurnTogether) {
  EXPECT_EQ(removed_by("object: house"), of_house_);
  EXPECT_EQ(removed_by("object: 'hal?'"), of_hall_);
  EXPECT_EQ(removed_by("selection: it", "selections: {it: {object: hall}}\n"), of_hall_);
  EXPECT_EQ(removed_by("object: quarter"), (Names{"house", "dormer", "steps", "mast", "shed"}));
  Heights moved = as_read();
  for (const char* name : {"hall_low", "hall_high", "chimney"})
    moved[name] = {moved[name].first + 2, moved[name].second + 2};
  EXPECT_EQ(heights(model("{object: hall, move_m: [0, 0, 2]}")), moved);
  const PolygonModel turned = model("{object: house, turn: {by_deg: 90, about_m: [0, 0]}}");
  for (std::size_t o = 0; o < turned.object_names.size(); ++o)
    if (turned.object_names[o] == "dormer") {
      EXPECT_EQ(extents_of(turned)[o].box.low, (Vec3{2, -3, 6}));
    }
}

TEST_F(Families, PlacesAreThoseOfTheWhole) {
  // About the middles of dormer and low part, and not of house and hall.
  EXPECT_NE(refusal("{polygon: [[1, 2], [3, 2], [3, 4], [1, 4]], remove: true}"), "");
  EXPECT_NE(refusal("{polygon: [[24, 4], [26, 4], [26, 6], [24, 6]], remove: true}"), "");
  EXPECT_EQ(removed_by("polygon: [[1, 2], [3, 2], [3, 4], [1, 4]], type: BuildingInstallation"),
            Names{"dormer"});
  EXPECT_EQ(removed_by("polygon: [[4, 4], [6, 4], [6, 6], [4, 6]]"), of_house_);
  EXPECT_EQ(removed_by("polygon: [[27, 4], [29, 4], [29, 6], [27, 6]]"), of_hall_);
  EXPECT_EQ(removed_by("near: {position_m: [2, 3]}"), of_house_);
  EXPECT_EQ(removed_by("near: {position_m: [2, 3]}, type: BuildingInstallation"), Names{"dormer"});
  EXPECT_EQ(removed_by("near: {position_m: [22, 5]}"), of_hall_);
  EXPECT_EQ(removed_by("near: {position_m: [44, 2], within_m: 5}"), Names{"shed"});
  EXPECT_EQ(removed_by("object: quarter, near: {position_m: [30, 2]}"), Names{"shed"})
      << "a group holds what stands apart";
}

TEST_F(Families, TellWhereNothingIsReadOfAName) {
  const std::string ruin = refusal("{object: ruin, remove: true}");
  EXPECT_NE(ruin.find("no object matches object 'ruin' (there are 8)"), ruin.npos) << ruin;
  EXPECT_NE(ruin.find("ruin is in the files, but nothing is read of it"), ruin.npos) << ruin;
  const std::string twice = refusal("{object: hall, remove: true}, {object: hall, remove: true}");
  EXPECT_NE(twice.find("hall is in the files, but"), twice.npos) << twice;
  const std::string slip = refusal("{object: hakl, remove: true}");
  EXPECT_NE(slip.find("did you mean 'hall'"), slip.npos) << slip;
}

TEST_F(Families, RulesAndSelectionsMeanThem) {
  EXPECT_EQ(painted_by("object: house"), of_house_);
  EXPECT_EQ(painted_by("object: hall"), of_hall_);
  EXPECT_EQ(painted_by("object: hall, type: BuildingPart"), (Names{"hall_low", "hall_high"}));
  EXPECT_EQ(painted_by("type: Building"), (Names{"house", "shed"})) << "a type is the object's own";
  EXPECT_EQ(painted_by("selection: it", "selections: {it: {object: hall}}\n"), of_hall_);
  EXPECT_EQ(painted_by("selection: it", "selections: {it: {near: {position_m: [2, 3]}}}\n"),
            of_house_);
}

TEST_F(Families, AreMeasured) {
  const VariantPlan plan = make_plan(
      study("repair: safe", "measures: {sky: {rule: bre_209_vsc, of: {object: hall}}}\n"));
  const VariantMesh made = unrefined_mesh(plan);
  StudyMeasures measures(plan, *made.mesh);
  const Mesh& mesh = plan.built.scene.mesh;
  Names names;
  for (const std::size_t patch : measures.all().front().patches)
    names.insert(mesh.object_names[mesh.triangle_object[static_cast<std::size_t>(
                                                            made.mesh->patches()[patch].triangle)]
                                       .index()]);
  EXPECT_EQ(names, of_hall_);
}

TEST_F(Families, LeaveHashesAsTheyWere) {
  Mesh mesh = build_scene(study("repair: safe")).scene.mesh;
  const std::string with_families = geometry_digest(mesh);
  ASSERT_FALSE(mesh.families.of_object.empty());
  mesh.families = {};
  EXPECT_EQ(geometry_digest(mesh), with_families);
}

TEST_F(Families, OfSeveralFilesStayApart) {
  folder_.write("again.city.json", family_town());
  const auto left = heights(model(
      "{add: {file: {file: again.city.json, position_m: [0, 50, 0]}}}, {object: hall_2, remove: "
      "true}, {object: house, remove: true}"));
  Names names;
  for (const auto& [name, range] : left) names.insert(name);
  EXPECT_EQ(names, (Names{"hall_low", "hall_high", "chimney", "shed", "house_2", "dormer_2",
                          "steps_2", "mast_2", "shed_2"}));
}

}  // namespace
}  // namespace sunload::test
