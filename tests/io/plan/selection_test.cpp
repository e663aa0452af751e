// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Selections: what they choose of objects, faces and patches.
#include "io/plan/selection.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numeric>

#include "io/plan/scene_build.h"
#include "io/plan/variant_mesh.h"
#include "io/plan/variant_plan.h"
#include "tests/support/refusal_of.h"
#include "tests/support/work_folder.h"

namespace sunload::test {
namespace {

constexpr double rounding_m2 = 1e-9;  // of sums of areas of some hundred m²

/// Two boxes in a row from west to east, 10 m wide, deep and 8 m high, 10 m apart, their feet at
/// z = 100 and far from the origin, with selections and what uses them.
class Selections : public testing::Test {
 protected:
  Study study(const std::string& selections, const std::string& scene = "",
              const std::string& more = "", const std::string& site = "") const {
    return read_study(
               folder_.write("s.yaml",
                             "format: sunload-study-1\nname: s\nsite: {timezone: UTC, "
                             "latitude_deg: 50, longitude_deg: 14" +
                                 site +
                                 "}\nperiod: {days: [2026-03-21]}\nmesh: {oracle: none, "
                                 "max_edge_m: 2.1}\nscene:\n  builtin: {name: box_on_plane, "
                                 "plane: 40}\n  materials: {grey: {diffuse: 0.4}, "
                                 "red: {diffuse: 0.3}}\n  edit:\n    - {object: box, remove: "
                                 "true}\n    - {add: {name: one, material: grey, box: "
                                 "{position_m: [-10, 0, 0], size_m: [10, 10, 8]}}}\n    - {add: "
                                 "{name: two, material: grey, box: {position_m: [10, 0, 0], "
                                 "size_m: [10, 10, 8]}}}\n" +
                                 scene + "\nselections: {" + selections + "}\n" + more))
        .variants.front();
  }

  /// Area of the first selection's patches.
  double area(const std::string& selection, const std::string& site = "") const {
    const VariantPlan plan = make_plan(study("a: {" + selection + "}", "", "", site));
    const VariantMesh made = unrefined_mesh(plan);
    const auto chosen = selected_patches(plan.study.selections.front(), plan.built, *made.mesh);
    double sum = 0;
    for (std::size_t i = 0; i < chosen.size(); ++i)
      sum += chosen[i] != 0 ? made.mesh->area()[i] : 0;
    return sum;
  }
  WorkFolder folder_;
};

TEST_F(Selections, EveryKeyChoosesAndAllMustHold) {
  EXPECT_NEAR(area("object: one, surface: wall"), 320, rounding_m2);
  EXPECT_NEAR(area("object: '*o*', surface: roof"), 200, rounding_m2);
  EXPECT_NEAR(area("surface: wall, azimuth_deg: [135, 225]"), 160, rounding_m2);
  EXPECT_NEAR(area("surface: wall, azimuth_deg: [315, 45]"), 160, rounding_m2);
  EXPECT_NEAR(area("facade: 'two/east_*'"), 80, rounding_m2);
  // Edges of 2 m: patches end at every second metre.
  EXPECT_NEAR(area("surface: wall, height_m: [0, 4]"), 320, 1);
  EXPECT_NEAR(area("near: {position_m: [12, 0]}, surface: roof"), 100, rounding_m2);
  EXPECT_NEAR(area("polygon: [[4, -6], [16, -6], [16, 6], [4, 6]], surface: roof"), 100,
              rounding_m2);
  EXPECT_NEAR(area("object: one, surface: ground"), 0, rounding_m2);
}

TEST_F(Selections, RangesTileTheCircle) {
  double sum = 0;
  for (const char* range : {"[0, 45]", "[45, 90]", "[90, 135]", "[135, 180]", "[180, 225]",
                            "[225, 270]", "[270, 315]", "[315, 360]"})
    sum += area(std::string("surface: wall, azimuth_deg: ") + range);
  EXPECT_NEAR(sum, 640, rounding_m2) << "walls on the rim of two ranges are in one of them";
}

// As of a model on a map, whose files have six decimals of metres or fewer.
TEST_F(Selections, WallsOnTheRimAreInARangeHoweverTheyAreRounded) {
  for (const double off_deg : {-0.005, -1e-5, 0.0, 1e-5, 0.005}) {
    const std::string north = fmt::format(", north_deg: {}", 45 + off_deg);
    EXPECT_NEAR(area("object: one, surface: wall, azimuth_deg: [135, 225]", north), 80, rounding_m2)
        << off_deg;
    EXPECT_NEAR(area("object: one, surface: wall, azimuth_deg: [45, 315]", north), 240, rounding_m2)
        << off_deg;
  }
  EXPECT_NEAR(area("object: one, surface: wall, azimuth_deg: [179.99, 180.01]"), 80, rounding_m2);
}

TEST_F(Selections, AzimuthsAreThoseOfTheEarth) {
  // +y points east: what looks along -x looks north.
  EXPECT_NEAR(area("object: one, azimuth_deg: [315, 45], facade: '*/north_*'", ", north_deg: 90"),
              80, rounding_m2);
}

TEST_F(Selections, PlaceByRadius) {
  const double all = area("surface: ground, near: {position_m: [0, 15], within_m: 3}");
  // A disk of 28.3 m² in patches of 2 m² at most.
  EXPECT_GT(all, 15);
  EXPECT_LT(all, 42);
}

TEST_F(Selections, GiveMaterialsAndChooseSteps) {
  const Study chosen =
      study("east: {polygon: [[4, -6], [16, -6], [16, 6], [4, 6]]}, up: {surface: roof}",
            "    - {selection: east, raise: {by_m: 2}}\n  assign: [{selection: up, object: one, "
            "material: red}]");
  const BuiltScene built = build_scene(chosen);
  const Mesh& mesh = built.scene.mesh;
  const auto extents = extents_of(mesh);
  for (std::size_t o = 0; o < mesh.object_names.size(); ++o) {
    const std::string& name = mesh.object_names[o];
    if (name != "plane") {
      EXPECT_NEAR(extents[o].box.high.z, name == "one" ? 8 : 10, 1e-9) << name;
    }
  }
  double red = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    if (built.scene.material_of(t).name == "red") red += mesh.area_m2(t);
  EXPECT_NEAR(red, 100, rounding_m2);
}

/// Area of a material.
double area_of(const std::string& material, const BuiltScene& built) {
  const Mesh& mesh = built.scene.mesh;
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    if (built.scene.material_of(t).name == material) sum += mesh.area_m2(t);
  return sum;
}

TEST_F(Selections, FacesAreCutAlongTheirEnds) {
  const std::string low = "a: {surface: wall, height_m: [0, 3]}";
  const std::string lawn =
      "a: {surface: ground, polygon: [[-18, -15], [-2, -17], [-4, -8], [-17, -9]]}";
  constexpr double of_lawn = 108.5;  // the shoelace formula
  const std::string rule = "  assign: [{selection: a, material: red}]";
  for (const auto& [selection, exact_m2] :
       {std::pair{low, 2.0 * 4 * 10 * 3}, std::pair{lawn, of_lawn}}) {
    const BuiltScene whole = build_scene(study(selection, rule));
    EXPECT_GT(std::abs(area_of("red", whole) - exact_m2), 1) << selection;
    ASSERT_FALSE(whole.warnings.empty());
    EXPECT_NE(whole.warnings.back().find("scene.cut: [a] cuts faces"), std::string::npos)
        << whole.warnings.back();
    const BuiltScene cut = build_scene(study(selection, rule + "\n  cut: [a]"));
    EXPECT_NEAR(area_of("red", cut), exact_m2, 1e-6) << selection;
    for (const auto& warning : cut.warnings)
      EXPECT_EQ(warning.find("scene.cut"), std::string::npos) << warning;
    EXPECT_EQ(cut.report.open_edges, whole.report.open_edges);
    EXPECT_EQ(cut.scene.mesh.facades.size(), whole.scene.mesh.facades.size());
  }
}

TEST_F(Selections, LeaveOutWhatOthersChoose) {
  const std::string low = "}, low: {height_m: [0, 4]";
  EXPECT_NEAR(area("surface: wall, except: [low]" + low), 640 - 320 * 2.0 / 2, 1);
  EXPECT_NEAR(
      area("surface: wall, except: [low, east]" + low + "}, east: {object: two, surface: wall"),
      160, 1);
  // Alone: all else. Of what is left out, too, something may be left out.
  EXPECT_NEAR(area("except: [ground]}, ground: {surface: ground"), 840, rounding_m2);
  EXPECT_NEAR(area("surface: roof, except: [b]}, b: {object: '*', except: [c]}, c: {object: two"),
              100, rounding_m2);
  const std::string others = "a: {object: '*o*', except: [b]}, b: {object: two}";
  const BuiltScene raised = build_scene(study(others, "    - {selection: a, raise: {by_m: 2}}"));
  const auto extents = extents_of(raised.scene.mesh);
  for (std::size_t o = 0; o < extents.size(); ++o)
    if (const std::string& name = raised.scene.mesh.object_names[o]; name != "plane") {
      EXPECT_NEAR(extents[o].box.high.z, name == "one" ? 10 : 8, 1e-9) << name;
    }
  const std::string upper = "a: {surface: wall, except: [b]}, b: {height_m: [0, 3]}";
  const std::string rule = "  assign: [{selection: a, material: red}]\n  cut: [a]";
  EXPECT_NEAR(area_of("red", build_scene(study(upper, rule))), 2.0 * 4 * 10 * 5, 1e-6);
  EXPECT_NE(canonical_text(study(upper, rule)),
            canonical_text(study("a: {surface: wall, except: [b]}, b: {height_m: [0, 4]}", rule)));
}

// The half of a rectangle is as large as one of its triangles, of which half lies beyond it.
TEST_F(Selections, WholeTrianglesOfTheSameAreaAreWarnedOf) {
  const std::string east =
      "a: {object: one, surface: roof, polygon: [[-10, -20], [0, -20], [0, 20], [-10, 20]]}";
  const BuiltScene whole = build_scene(study(east, "  assign: [{selection: a, material: red}]"));
  EXPECT_NEAR(area_of("red", whole), 50, rounding_m2);
  ASSERT_FALSE(whole.warnings.empty());
  EXPECT_NE(whole.warnings.back().find("of 50 m2 that selection 'a' holds 12.5 m2 do not get "
                                       "material 'red', and 12.5 m2 beside them do"),
            std::string::npos)
      << whole.warnings.back();
  // A rule that gives nothing of what is cut is none to warn of.
  const BuiltScene other =
      build_scene(study(east, "  assign: [{selection: a, surface: wall, material: red}]"));
  for (const auto& warning : other.warnings)
    EXPECT_EQ(warning.find("scene.cut"), std::string::npos) << warning;
}

TEST_F(Selections, CutsAreHashedByWhatTheyAre) {
  const auto text = [&](const std::string& height) {
    return canonical_text(study("a: {height_m: [0, " + height + "]}", "  cut: [a]"));
  };
  EXPECT_NE(text("3"), text("4"));
  EXPECT_NE(text("3"), canonical_text(study("a: {height_m: [0, 3]}")));
}

TEST_F(Selections, WithoutEndsNothingCanBeCut) {
  const std::string said = refusal_of([&] { study("a: {surface: wall}", "  cut: [a]"); });
  EXPECT_NE(said.find("selection 'a' has no ends to cut faces along"), std::string::npos) << said;
  EXPECT_NE(refusal_of([&] {
              study("a: {surface: wall}", "  cut: [b]");
            }).find("no selection is called 'b'"),
            std::string::npos);
}

TEST_F(Selections, WhatTheyAreIsHashedWhereTheyAreUsed) {
  const std::string rule = "  assign: [{selection: a, material: red}]";
  const auto text = [&](const std::string& name, const std::string& of, const std::string& scene) {
    return canonical_text(study(name + ": {" + of + "}", scene));
  };
  EXPECT_EQ(text("a", "surface: roof", ""), text("a", "surface: wall", ""));
  EXPECT_NE(text("a", "surface: roof", rule), text("a", "surface: wall", rule));
  const std::string step = "    - {selection: a, raise: {by_m: 1}}";
  EXPECT_EQ(text("a", "object: one", step), text("a", "object: one", step));
  EXPECT_NE(text("a", "object: one", step), text("a", "object: two", step));
  EXPECT_NE(measures_text(study("a: {surface: roof}")), measures_text(study("a: {surface: wall}")));
}

TEST_F(Selections, RefusesWhatCannotBe) {
  const auto refusal = [&](const std::string& selections, const std::string& scene = "",
                           const std::string& more = "") {
    return refusal_of([&] { build_scene(study(selections, scene, more)); });
  };
  const auto names = [](const std::string& text, const std::string& what) {
    return text.find(what) != std::string::npos;
  };
  const auto unknown =
      refusal("windows: {surface: window}", "  assign: [{selection: window, material: red}]");
  EXPECT_TRUE(names(unknown, "no selection is called 'window'")) << unknown;
  EXPECT_TRUE(names(unknown, "did you mean 'windows'?")) << unknown;
  const auto parts = refusal("up: {surface: roof}", "    - {selection: up, remove: true}");
  EXPECT_TRUE(names(parts, "chooses parts of objects")) << parts;
  const auto far =
      refusal("a: {near: {position_m: [1e6, 0]}}", "  assign: [{selection: a, material: red}]");
  EXPECT_TRUE(names(far, "selections.a: [1000000, 0] is")) << far;
  EXPECT_TRUE(names(refusal("a: {}"), "chooses nothing"));
  const auto circle = refusal("a: {except: [b]}, b: {object: one, except: [a]}");
  EXPECT_TRUE(names(circle, "selection 'a' leaves out itself (by way of a, b)")) << circle;
  EXPECT_TRUE(names(refusal("a: {except: [b]}"), "no selection is called 'b'"));
  const auto excepted = refusal("up: {surface: roof}, a: {object: one, except: [up]}",
                                "    - {selection: a, remove: true}");
  EXPECT_TRUE(names(excepted, "'a' chooses parts of objects")) << excepted;
  EXPECT_TRUE(names(refusal("'a b': {surface: wall}"), "cannot be the name of a selection"));
  EXPECT_TRUE(names(refusal("a: {height_m: [4, 0]}"), "selections.a.height_m"));
  EXPECT_TRUE(names(refusal("a: {azimuth_deg: [90]}"), "selections.a.azimuth_deg"));
  const auto measured = refusal("south: {azimuth_deg: [135, 225]}", "",
                                "measures: {m: {rule: bre_209_vsc, of: {selection: sout}}}\n");
  EXPECT_TRUE(names(measured, "did you mean 'south'?")) << measured;
}

}  // namespace
}  // namespace sunload::test
