// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Steps of scene.edit: what they choose, what becomes of it, and what is said of it.
#include "io/plan/scene_edit.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "geo/edit/objects.h"
#include "io/plan/scene_build.h"
#include "io/plan/scene_models.h"
#include "tests/support/refusal_of.h"
#include "tests/support/work_folder.h"

namespace sunload::test {
namespace {

class SceneEdit : public testing::Test {
 protected:
  Study study(const std::string& steps, const std::string& more = "") const {
    return read_study(folder_.write(
                          "s.yaml",
                          "format: sunload-study-1\nname: s\nsite: {timezone: UTC, latitude_deg: "
                          "50, longitude_deg: 14}\nperiod: {days: [2026-03-21]}\nscene: {files: "
                          "[town.obj], edit: [" +
                              steps + "]" + more + "}\n"))
        .variants.front();
  }
  PolygonModel model(const std::string& steps) const {
    const Study with_steps = study(steps);
    return edited(read_models(with_steps), with_steps).model;
  }
  std::string refusal(const std::string& steps) const {
    return refusal_of([&] { model(steps); });
  }
  SceneEdit() { folder_.write("town.obj", town()); }

  /// house_1 about (5, 5) and house_2 about (25, 5), boxes of 10 m by 10 m and 6 m; shed at (45,
  /// 5).
  static std::string town() {
    std::string text;
    int first = 1;
    for (const auto& [name, x] :
         {std::pair{"house_1", 0}, std::pair{"house_2", 20}, std::pair{"shed", 40}}) {
      text += std::string("o ") + name + "\n";
      for (const int z : {0, 6})
        for (const auto& [dx, dy] :
             {std::pair{0, 0}, std::pair{10, 0}, std::pair{10, 10}, std::pair{0, 10}})
          text += "v " + std::to_string(x + dx) + " " + std::to_string(dy) + " " +
                  std::to_string(z) + "\n";
      const auto face = [&](int a, int b, int c, int d) {
        text += "f";
        for (const int v : {a, b, c, d}) text += " " + std::to_string(first + v);
        text += "\n";
      };
      face(3, 2, 1, 0);
      face(4, 5, 6, 7);
      for (int i = 0; i < 4; ++i) face(i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i);
      first += 8;
    }
    return text;
  }

  static Box box_of(const PolygonModel& model, const std::string& name) {
    const auto found = std::find(model.object_names.begin(), model.object_names.end(), name);
    if (found == model.object_names.end()) return {};
    return extents_of(model)[static_cast<std::size_t>(found - model.object_names.begin())].box;
  }
  using Names = std::vector<std::string>;
  WorkFolder folder_;
};

TEST_F(SceneEdit, ChoosesByNamePolygonAndNearness) {
  EXPECT_EQ(model("{object: 'house_*', remove: true}").object_names, Names{"shed"});
  EXPECT_EQ(model("{polygon: [[-1, -1], [28, -1], [28, 11], [-1, 11]], remove: true}").object_names,
            Names{"shed"});
  EXPECT_EQ(model("{near: {position_m: [33, 5]}, remove: true}").object_names,
            (Names{"house_1", "shed"}));
  EXPECT_EQ(model("{near: {position_m: [35, 5], within_m: 5}, remove: true}").object_names,
            Names{"house_1"});
  // All that is written must hold.
  EXPECT_EQ(model("{object: 'house_*', near: {position_m: [45, 5]}, remove: true}").object_names,
            (Names{"house_1", "shed"}));
}

TEST_F(SceneEdit, TellsWhatItHasChosen) {
  const auto notes = model("{object: 'house_*', raise: {storeys: 2, storey_m: 3}}").notes;
  ASSERT_FALSE(notes.empty());
  EXPECT_EQ(notes.back(),
            "scene.edit[1]: raises by 6 m 2 objects: house_1, house_2 (cut at z = 6 m)");
}

/// Of a row, b stands between a and c: floor and roof, and walls to the south and north alone.
TEST_F(SceneEdit, TellsOfWallsThatItAdds) {
  folder_.write("town.obj",
                "o b\nv 6 0 0\nv 6 10 0\nv 12 10 0\nv 12 0 0\nv 6 0 6\nv 12 0 6\nv 12 10 6\nv 6 10 "
                "6\nf 1 2 3 4\nf 5 6 7 8\nf 1 4 6 5\nf 3 2 8 7\n");
  EXPECT_EQ(model("{object: b, raise: {by_m: 6}}").notes.back(),
            "scene.edit[1]: raises by 6 m 1 object: b (cut at z = 6 m; walls added along 20 of 32 "
            "m)");
  EXPECT_EQ(model("{object: b, raise: {by_m: -2}}").notes.back(),
            "scene.edit[1]: lowers along lines without a wall, where neighbours may stand open "
            "now, 1 object: b (along 20 of 32 m)");
}

TEST_F(SceneEdit, TellsOfAllStepsAtOnce) {
  const std::string said = refusal(
      "{object: huose_1, remove: true}, {object: shed, move_m: [0, 1, 0]}, {object: sehd, remove: "
      "true}");
  EXPECT_NE(said.find("scene.edit[1]: no object matches object 'huose_1'"), std::string::npos);
  EXPECT_NE(said.find("scene.edit[3]: no object matches object 'sehd'"), std::string::npos);
  // What a step was to bring may be meant by those after it.
  const std::string of_added =
      refusal("{add: {file: {file: nowhere.obj}}}, {object: tower, remove: true}");
  EXPECT_EQ(of_added.find("tower"), std::string::npos) << of_added;
}

TEST_F(SceneEdit, RefusesAStepThatMatchesNothing) {
  const std::string said =
      refusal("{object: shed, move_m: [0, 1, 0]}, {object: huose_1, remove: true}");
  EXPECT_NE(said.find("scene.edit[2]: no object matches object 'huose_1' (there are 3)"), said.npos)
      << said;
  EXPECT_NE(said.find("did you mean 'house_1'"), said.npos) << said;
  EXPECT_NE(said.find("s.yaml:5:"), said.npos) << said;
}

TEST_F(SceneEdit, RefusesPlacesOfAnotherFrame) {
  for (const char* step :
       {"{near: {position_m: [683000, 5511000]}, remove: true}",
        "{add: {tree: {position_m: [683000, 5511000, 0], height_m: 9, crown_m: 5}}}"}) {
    const auto told = refusal(step);
    EXPECT_NE(told.find("m away from the model"), told.npos) << told;
    EXPECT_NE(told.find("x 0 to 50"), told.npos) << told;
  }
  EXPECT_EQ(model("{near: {position_m: [900, 5]}, remove: true}").object_names,
            (Names{"house_1", "house_2"}));
}

TEST_F(SceneEdit, StepsFollowEachOther) {
  const auto m = model(
      "{object: house_1, raise: {by_m: 3}}, {object: house_1, move_m: [0, 0, 1]}, {object: "
      "house_2, turn: {by_deg: 90, about_m: [20, 0]}}");
  EXPECT_EQ(box_of(m, "house_1").low.z, 1);
  EXPECT_EQ(box_of(m, "house_1").high.z, 10);
  EXPECT_EQ(box_of(m, "house_2").low, (Vec3{20, -10, 0}));  // clockwise from above, exactly
  EXPECT_EQ(box_of(m, "house_2").high, (Vec3{30, 0, 6}));
}

TEST_F(SceneEdit, AddsBodiesOnTheGroundThatIsThere) {
  const auto m = model(
      "{object: shed, move_m: [0, 0, 2]}, {add: {box: {position_m: [70, 5], size_m: [4, 6, 3]}}}, "
      "{add: {name: shed, footprint: {polygon: [[0, 20], [9, 20], [9, 30]], height_m: 5}}}, "
      "{add: {tree: {position_m: [0, -10], height_m: 8, crown_m: 4, trunk_m: 2, to_m: [25, -10], "
      "every_m: 10}}}");
  EXPECT_EQ(m.object_names,
            (Names{"house_1", "house_2", "shed", "box", "shed_2", "tree_1", "tree_2", "tree_3"}));
  EXPECT_EQ(box_of(m, "box").low.z, 2);  // as the shed, which is nearest
  EXPECT_EQ(box_of(m, "box").high.z, 5);
  EXPECT_EQ(box_of(m, "tree_3").low.z, 0);
  EXPECT_NEAR(extents_of(m)[7].middle().x, 20, 1e-9);  // of sums of some cosines
}

// Crowns hover: what is put beside one stands where the houses do.
TEST_F(SceneEdit, AddsNothingAtTheHeightOfACrown) {
  const auto m = model(
      "{add: {tree: {position_m: [70, 5, 3], height_m: 8, crown_m: 4, trunk_m: 0}}}, "
      "{add: {box: {position_m: [75, 5], size_m: [4, 6, 3]}}}");
  EXPECT_EQ(box_of(m, "box").low.z, 0);
}

// The ground goes through the feet of houses, and a tree has none, whatever the files are.
TEST_F(SceneEdit, TreesLeaveTheGroundAsItIs) {
  const BuiltScene built = build_scene(
      study("{add: {tree: {position_m: [15, 5], height_m: 7, crown_m: 4, trunk_m: 2}}}, "
            "{add: {tree: {position_m: [35, 5], height_m: 7, crown_m: 4, trunk_m: 0}}}",
            ", ground: {}"));
  ASSERT_TRUE(built.report.ground);
  EXPECT_TRUE(built.report.ground->is_level);
  EXPECT_EQ(built.report.ground->standing, 3u);
  for (std::size_t t = 0; t < built.scene.mesh.triangle_count(); ++t)
    if (built.scene.mesh.triangle_surface[t] == Surface::ground) {
      EXPECT_EQ(built.scene.mesh.corner(t, 0).z + built.scene.mesh.origin.z, 0);
    }
}

/// Points in the metres of the model, as a file of its map has them.
std::string points(const std::vector<std::array<double, 2>>& places) {
  std::string text = R"({"type": "FeatureCollection", "features": [)";
  for (std::size_t i = 0; i < places.size(); ++i)
    text += fmt::format(
        R"({}{{"type": "Feature", "properties": {{"height": {}, "crown_m": 4, "id": "t{}"}}, )"
        R"("geometry": {{"type": "Point", "coordinates": [{}, {}]}}}})",
        i == 0 ? "" : ", ", 8 + i, i, places[i][0], places[i][1]);
  return text + "]}";
}

TEST_F(SceneEdit, AddsTheTreesOfAnInventory) {
  folder_.write("trees.geojson", points({{1015, 505}, {1045, 520}, {1400, 505}}));
  Study with = study("{object: shed, move_m: [0, 0, 2]}, {add: {trees: {file: trees.geojson}}}");
  with.site.crs = "EPSG:32633";
  with.scene.files.front().position = Vec3{1000, 500, 0};
  const EditedModel all = edited(read_models(with), with);
  const auto& m = all.model;
  EXPECT_EQ(m.object_names, (Names{"house_1", "house_2", "shed", "tree_t0", "tree_t1"}));
  EXPECT_EQ(all.placed.count("tree_t1"), 1u);
  EXPECT_EQ(box_of(m, "tree_t0").low.z, 0);
  EXPECT_EQ(box_of(m, "tree_t0").high.z, 8);
  EXPECT_EQ(box_of(m, "tree_t1").low.z, 2);  // as the shed, which is nearest
  EXPECT_EQ(box_of(m, "tree_t1").high.z, 11);
  EXPECT_NEAR(extents_of(m)[3].middle().x, 1015, 1e-9);
  const auto said = [&](const std::string& what) {
    return std::any_of(m.notes.begin(), m.notes.end(),
                       [&](const auto& note) { return note.find(what) != note.npos; });
  };
  EXPECT_TRUE(said("scene.edit[2]: 1 trees more than 20 m beside the model left out"));
  EXPECT_TRUE(said("scene.edit[2]: adds 2 objects: tree_t0, tree_t1"));

  folder_.write("trees.geojson", points({{91015, 505}}));
  const std::string told = refusal_of([&] { edited(read_models(with), with); });
  EXPECT_NE(told.find("m away from the model"), told.npos) << told;
  folder_.write("trees.geojson", points({{1300, 505}}));
  const std::string beside = refusal_of([&] { edited(read_models(with), with); });
  EXPECT_NE(beside.find("none of 1 trees stands on the model"), beside.npos) << beside;
}

TEST_F(SceneEdit, PutsThingsOntoATerrainOfARaster) {
  folder_.write("town.obj", "o far\nv 90 90 9\nv 91 90 9\nv 90 91 9\nf 1 2 3\n");
  folder_.write("dem.asc",
                "ncols 3\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 40\nnodata_value -9999\n"
                "0 10 20\n0 10 20\n0 10 20\n");
  Study with = study("{add: {box: {position_m: [40, 60], size_m: [4, 6, 3]}}}");
  with.scene.files.front().path = folder_ / "dem.asc";
  const auto m = edited(read_models(with), with).model;
  EXPECT_EQ(box_of(m, "box").low.z, 5);  // between the cells of 0 and 10 m
}

/// In plain scenes as well: written as Building, the ground that is read back would rise to crowns.
TEST_F(SceneEdit, TreesArePlantsOfEveryScene) {
  const std::string tree =
      "{add: {tree: {position_m: [0, -10], height_m: 8, crown_m: 4, to_m: [5, -10], every_m: 5}}}";
  const auto m = model(tree + ", {add: {box: {position_m: [70, 5], size_m: [4, 6, 3]}}}");
  ASSERT_EQ(m.object_names, (Names{"house_1", "house_2", "shed", "tree_1", "tree_2", "box"}));
  EXPECT_EQ(m.object_kinds,
            (Names{"", "", "", "SolitaryVegetationObject", "SolitaryVegetationObject", ""}));
  EXPECT_EQ(model(tree + ", {type: SolitaryVegetationObject, remove: true}").object_names,
            (Names{"house_1", "house_2", "shed"}));
  const auto built = build_scene(study(tree));
  const Mesh& mesh = built.scene.mesh;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.object_kinds[mesh.triangle_object[t].index()] == "SolitaryVegetationObject") {
      EXPECT_EQ(mesh.triangle_surface[t], Surface::other) << t;
    }
}

TEST_F(SceneEdit, ReplacesByAFile) {
  folder_.write("new.obj", "o tower\nv 0 0 0\nv 2 0 0\nv 0 1 40\nf 1 2 3\n");
  const auto m = model("{object: house_2, replace: {file: new.obj, position_m: [20, 0, 0]}}");
  EXPECT_EQ(m.object_names, (Names{"house_1", "shed", "tower"}));
  EXPECT_EQ(box_of(m, "tower").high, (Vec3{22, 1, 40}));
}

TEST_F(SceneEdit, ReadsGeoJson) {
  const std::string polygon =
      R"({"type": "Polygon", "coordinates": [[[0,20],[8,20],[8,24],[0,24],[0,20]]]})";
  folder_.write("a.json", R"({"type": "FeatureCollection", "features": [{"type": "Feature",
    "properties": {}, "geometry": )" +
                              polygon + "}]}");
  const auto m = model("{add: {footprint: {polygon: a.json, height_m: 5}}}");
  EXPECT_EQ(box_of(m, "block").high, (Vec3{8, 24, 5}));
  folder_.write("b.json", R"({"type": "Point", "coordinates": [0, 20]})");
  const std::string said = refusal_of([&] { study("{polygon: b.json, remove: true}"); });
  EXPECT_NE(said.find("holds no polygon"), said.npos) << said;
}

TEST_F(SceneEdit, MakesScenesThatArePreparedAsAnyOther) {
  const BuiltScene built = build_scene(
      study("{object: house_1, raise: {by_m: 4}}, {add: {tree: {position_m: [15, 5], height_m: 6, "
            "crown_m: 3, trunk_m: 2}}}, {add: {material: brick, box: {position_m: [5, 30], size_m: "
            "[4, 4, 4]}}}",
            ", ground: {}"));
  EXPECT_EQ(built.report.closed_bodies, 6u);  // three houses, a box, crown and trunk
  EXPECT_EQ(built.report.open_edges, 0u);
  const auto has_material = [&](const std::string& name) {
    return std::any_of(built.scene.materials.begin(), built.scene.materials.end(),
                       [&](const Material& m) { return m.name == name; });
  };
  EXPECT_TRUE(has_material("crown"));
  EXPECT_TRUE(has_material("wood"));
  EXPECT_TRUE(has_material("brick"));
}

TEST_F(SceneEdit, LeavesTheSiteWhereItIs) {
  const auto site_with = [&](const std::string& steps) {
    const auto path = folder_.write(
        "on_map.yaml",
        "format: sunload-study-1\nname: s\nsite: {timezone: UTC, crs: \"EPSG:25833\"}\nperiod: "
        "{days: [2026-03-21]}\nscene: {files: [{file: town.obj, position_m: [390000, 5800000, "
        "30]}], edit: [" +
            steps + "]}\n");
    return build_scene(read_study(path).variants.front()).site;
  };
  const Site before = site_with("{object: shed, turn: {by_deg: 90}}");
  const Site after = site_with(
      "{object: shed, remove: true}, {add: {tree: {position_m: [390200, 5800100], height_m: 9, "
      "crown_m: 5}}}");
  EXPECT_EQ(after.latitude_deg, before.latitude_deg);
  EXPECT_EQ(after.longitude_deg, before.longitude_deg);
  EXPECT_EQ(after.elevation_m, before.elevation_m);
}

TEST_F(SceneEdit, RefusesScenesThatAreLeftWithoutASurface) {
  const auto built = [&](const Study& of) { return refusal_of([&] { build_scene(of); }); };
  const std::string empty = built(study("{object: '*', remove: true}"));
  EXPECT_NE(empty.find("scene.edit leaves nothing of the scene"), empty.npos) << empty;
  // The floor of a house alone: it touches the ground.
  folder_.write(
      "floor.city.json",
      R"({"type":"CityJSON","version":"1.1","transform":{"scale":[1,1,1],"translate":[0,0,0]},)"
      R"("CityObjects":{"b":{"type":"Building","geometry":[{"type":"MultiSurface","lod":"1",)"
      R"("boundaries":[[[0,3,2,1]]],"semantics":{"surfaces":[{"type":"GroundSurface"}],)"
      R"("values":[0]}}]}},"vertices":[[0,0,0],[10,0,0],[10,10,0],[0,10,0]]})");
  const std::string dark = built(
      read_study(folder_.write("floor.yaml",
                               "format: sunload-study-1\nname: s\nsite: {timezone: UTC, "
                               "latitude_deg: 50, longitude_deg: 14}\nperiod: {days: "
                               "[2026-03-21]}\nscene: {files: [floor.city.json], ground: none}\n"))
          .variants.front());
  EXPECT_NE(dark.find("no surface of the scene can receive light"), dark.npos) << dark;
}

TEST_F(SceneEdit, RefusesWhatCannotBeRaised) {
  folder_.write("town.obj", "o plate\nv 0 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string said = refusal("{object: plate, raise: {by_m: 3}}");
  EXPECT_NE(said.find("scene.edit[1]: plate has no roof"), said.npos) << said;
}

/// Of a file with y up, as many modellers write, in a scene with z up.
TEST_F(SceneEdit, FilesSayWhichAxisPointsUp) {
  folder_.write("mast.obj",
                "o mast\nv 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nv 0 20 0\nv 1 20 0\nv 1 20 1\n"
                "v 0 20 1\nf 1 2 3 4\nf 8 7 6 5\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n");
  for (const char* step :
       {"{add: {file: {file: mast.obj, up: y, position_m: [60, 5, 0]}}}",
        "{object: shed, replace: {file: mast.obj, up: y, position_m: [60, 5, 0]}}"}) {
    const PolygonModel m = model(step);
    const auto extents = extents_of(m);
    EXPECT_EQ(m.object_names.back(), "mast");
    EXPECT_NEAR(extents.back().box.high.z, 20, 1e-9) << step;
    EXPECT_NEAR(extents.back().box.high.y, 5, 1e-9) << step;
  }
}

TEST_F(SceneEdit, WhatItPutsInsideOfOthersIsWarnedOf) {
  const auto warnings = [&](const std::string& steps) {
    std::string all;
    for (const auto& warning : build_scene(study(steps)).warnings) all += warning + "\n";
    return all;
  };
  const auto names = [](const std::string& text, const std::string& what) {
    return text.find(what) != std::string::npos;
  };
  const std::string inside = "1 object lies wholly inside others: ";
  const auto tree =
      warnings("{add: {tree: {position_m: [5, 5, 0], height_m: 4, crown_m: 2, trunk_m: 1}}}");
  EXPECT_TRUE(names(tree, inside + "tree (no light comes there")) << tree;
  const auto moved = warnings(
      "{add: {name: kiosk, box: {position_m: [60, 5, 0], size_m: [3, 3, 3]}}}, "
      "{object: kiosk, move_m: [-35, 0, 0]}");
  EXPECT_TRUE(names(moved, inside + "kiosk")) << moved;
  const auto beside =
      warnings("{add: {name: kiosk, box: {position_m: [60, 5, 0], size_m: [3, 3, 3]}}}");
  EXPECT_FALSE(names(beside, "inside others")) << beside;
}

/// No ground climbs to a deck; a house far above the others stands on a slope.
TEST_F(SceneEdit, WhatIsLowAndFarAboveTheLandHangsInTheAir) {
  const Study with = study(
      "{add: {name: deck, box: {position_m: [75, 5, 5], size_m: [10, 8, 0.5]}}}, "
      "{add: {name: deck_2, box: {position_m: [85, 5, 5], size_m: [10, 8, 0.5]}}}, "
      "{add: {name: penthouse, box: {position_m: [5, 5, 6], size_m: [4, 4, 1.5]}}}, "
      "{add: {name: balcony, box: {position_m: [5, -1, 3], size_m: [4, 2, 0.2]}}}, "
      "{add: {name: terrace, box: {position_m: [75, 25, 1], size_m: [10, 8, 0.5]}}}, "
      "{add: {name: villa, box: {position_m: [75, 45, 5], size_m: [10, 8, 6]}}}",
      ", ground: {margin_m: 10}");
  const EditedModel made = edited(read_models(with), with);
  const auto kind = [&](const std::string& name) {
    const auto& names = made.model.object_names;
    return made.model.object_kinds[static_cast<std::size_t>(
        std::find(names.begin(), names.end(), name) - names.begin())];
  };
  for (const char* name : {"deck", "deck_2"}) EXPECT_EQ(kind(name), "BuildingInstallation");
  for (const char* name : {"penthouse", "balcony", "terrace", "villa"}) EXPECT_EQ(kind(name), "");
  const auto is_told = [&](const std::string& text) {
    return std::ranges::any_of(made.model.notes, [&](const std::string& note) {
      return note.find(text) != std::string::npos;
    });
  };
  EXPECT_TRUE(is_told("from z = 5.00 m, 5.00 m in the air, 1 object: deck"));
  EXPECT_TRUE(
      is_told("from z = 5.00 m, 4.00 m above the land there, to which a made ground rises, "
              "1 object: villa"));
}

}  // namespace
}  // namespace sunload::test
