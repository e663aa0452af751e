// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Objects of plain files that the study calls land.
#include "io/plan/scene_land.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geo/base/check.h"
#include "geo/mesh/delaunay.h"
#include "io/plan/scene_build.h"
#include "tests/support/work_folder.h"

namespace sunload::test {
namespace {

PolygonModel model_of(const std::vector<std::string>& names) {
  PolygonModel model;
  model.object_names = names;
  return model;
}

TEST(SceneLand, IsTerrainByName) {
  PolygonModel model = model_of({"house", "terrain_1", "terrain_2"});
  SceneStudy scene;
  scene.land = {{"terrain_*", {"study.yaml", 3, 7}}};
  call_land(scene, model);
  EXPECT_EQ(model.object_kinds, (std::vector<std::string>{"", "TINRelief", "TINRelief"}));
}

TEST(SceneLand, ThatIsNotThereIsRefusedEachByItself) {
  PolygonModel model = model_of({"house", "terrain"});
  SceneStudy scene;
  scene.land = {{"terain", {"study.yaml", 3, 7}}, {"lake", {"study.yaml", 3, 15}}};
  try {
    call_land(scene, model);
    FAIL() << "refused";
  } catch (const InputError& error) {
    ASSERT_EQ(error.problems().size(), 2u);
    EXPECT_NE(error.problems()[0].find("study.yaml:3:7: scene.land: no object is called 'terain'"),
              std::string::npos)
        << error.problems()[0];
    EXPECT_NE(error.problems()[0].find("did you mean 'terrain'?"), std::string::npos);
  }
  EXPECT_TRUE(model.object_kinds.empty());
}

TEST(SceneLand, ThatLooksDownIsTurnedOverUnlessFrontsAreKept) {
  for (const auto orient : {Orientation::outward, Orientation::keep}) {
    PolygonModel model = model_of({"terrain", "house"});
    model.vertices = {{0, 0, 0}, {0, 9, 1}, {9, 9, 2}, {9, 0, 1}, {3, 3, 1}, {6, 3, 1}, {3, 6, 1}};
    model.add_polygon({{0, 1, 2, 3}, {4, 5, 6}}, {ObjectId{0}});  // with a hole
    model.add_triangle(0, 1, 2, {ObjectId{1}});
    SceneStudy scene;
    scene.land = {{"terrain", {}}};
    scene.orient = orient;
    call_land(scene, model);
    const bool is_turned = orient == Orientation::outward;
    EXPECT_EQ(model.notes.size(), is_turned ? 1u : 0u);
    EXPECT_EQ(model.ring_vertex, is_turned
                                     ? std::vector<std::int32_t>({0, 3, 2, 1, 4, 6, 5, 0, 1, 2})
                                     : std::vector<std::int32_t>({0, 1, 2, 3, 4, 5, 6, 0, 1, 2}));
  }
}

BuiltScene scene_of(const WorkFolder& folder, const std::string& obj, const std::string& more) {
  folder.write("town.obj", obj);
  const std::string study =
      folder.write("town.yaml",
                   "format: sunload-study-1\nname: town\n"
                   "site: {latitude_deg: 52, longitude_deg: 4.4, timezone: UTC}\n"
                   "period: {days: [2026-03-21]}\nscene: {files: [town.obj]" +
                       more + "}\n");
  return build_scene(read_study(study).variants.front());
}

/// A house three metres deep in a flat terrain.
BuiltScene house_in_terrain(const WorkFolder& folder, const std::string& more) {
  return scene_of(folder,
                  "o terrain\nv -50 -50 0\nv 50 -50 0\nv 50 50 0\nv -50 50 0\nf 1 2 3 4\n"
                  "o house\nv -5 -5 -3\nv 5 -5 -3\nv 5 5 -3\nv -5 5 -3\n"
                  "v -5 -5 6\nv 5 -5 6\nv 5 5 6\nv -5 5 6\n"
                  "f 8 7 6 5\nf 9 10 11 12\nf 5 6 10 9\nf 6 7 11 10\nf 7 8 12 11\nf 8 5 9 12\n",
                  more);
}

double lit_walls_m2(const BuiltScene& built) {
  const auto wall = static_cast<std::size_t>(Surface::wall);
  return built.report.area_m2[wall] - built.report.covered_m2[wall];
}

bool warns_of_sunk_walls(const BuiltScene& built) {
  return std::ranges::any_of(built.warnings, [](const std::string& warning) {
    return warning.starts_with("120 m2 of walls go on below the open surface of terrain");
  });
}

TEST(SceneLand, OfACityThatLooksDownIsTurnedOver) {
  PolygonModel model = model_of({"relief", "lake", "house"});
  model.object_kinds = {"TINRelief", "WaterBody", "Building"};
  model.vertices = {{0, 0, 0}, {0, 9, 1}, {9, 9, 2}};
  model.add_triangle(0, 1, 2, {ObjectId{0}});
  model.add_triangle(0, 1, 2, {ObjectId{1}});
  model.add_triangle(0, 2, 1, {ObjectId{1}});  // a body of water has an underside
  model.add_triangle(0, 1, 2, {ObjectId{2}});
  const auto before = model.ring_vertex;
  call_land({}, model);
  ASSERT_EQ(model.notes.size(), 1u);
  EXPECT_NE(model.notes[0].find("relief: land that looked down"), std::string::npos);
  EXPECT_EQ(newell(model.vertices, {model.ring_vertex.begin(), model.ring_vertex.begin() + 3}).z,
            81);
  EXPECT_TRUE(std::equal(before.begin() + 3, before.end(), model.ring_vertex.begin() + 3));
  EXPECT_EQ(model.object_kinds[0], "TINRelief");
}

TEST(SceneLand, ThatIsNoneIsTold) {
  const BuiltScene built = house_in_terrain(WorkFolder(), ", land: [house]");
  EXPECT_TRUE(std::ranges::any_of(built.warnings, [](const std::string& warning) {
    return warning.find("scene.land: 'house' has no open surface that looks up") !=
           std::string::npos;
  }));
}

/// Where one object holds houses and the land about them all of its walls are ground.
TEST(SceneLand, ThatHoldsHousesIsTold) {
  const auto told = [](const std::string& height) {
    const BuiltScene built = scene_of(
        WorkFolder(),
        "o model\nv -20 -20 0\nv 20 -20 0\nv 20 20 0\nv -20 20 0\nv -5 -5 0\nv 5 -5 0\nv 5 5 0\n"
        "v -5 5 0\nv -5 -5 " +
            height + "\nv 5 -5 " + height + "\nv 5 5 " + height + "\nv -5 5 " + height +
            "\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nf 9 10 11 12\nf 5 6 10 9\n"
            "f 6 7 11 10\nf 7 8 12 11\nf 8 5 9 12\n",
        ", land: [model]");
    return std::ranges::any_of(built.warnings, [](const std::string& warning) {
      return warning.find("240 m2 of 'model' are upright (first in model)") != warning.npos;
    });
  };
  EXPECT_TRUE(told("6"));
  EXPECT_FALSE(told("0.4"));  // a terrace
}

TEST(SceneLand, CoversWhatLiesBelow) {
  const WorkFolder folder;
  constexpr double above_m2 = 4 * 10 * 6, below_m2 = 4 * 10 * 3, rounding_m2 = 1e-6;
  const BuiltScene plain = house_in_terrain(folder, "");
  EXPECT_NEAR(lit_walls_m2(plain), above_m2 + below_m2, rounding_m2);
  EXPECT_TRUE(warns_of_sunk_walls(plain));
  const BuiltScene on_land = house_in_terrain(folder, ", land: [terrain]");
  EXPECT_NEAR(lit_walls_m2(on_land), above_m2, rounding_m2);
  EXPECT_FALSE(warns_of_sunk_walls(on_land));
}

TEST(SceneLand, TellsWhatLiesWhollyBelow) {
  const auto is_told = [](const std::string& low, const std::string& high) {
    const BuiltScene built =
        scene_of(WorkFolder(),
                 "o terrain\nv -50 -50 0\nv 50 -50 0\nv 50 50 0\nv -50 50 0\nf 1 2 3 4\n"
                 "o house\nv -5 -5 " +
                     low + "\nv 5 -5 " + low + "\nv 5 5 " + low + "\nv -5 5 " + low + "\nv -5 -5 " +
                     high + "\nv 5 -5 " + high + "\nv 5 5 " + high + "\nv -5 5 " + high +
                     "\n"
                     "f 8 7 6 5\nf 9 10 11 12\nf 5 6 10 9\nf 6 7 11 10\nf 7 8 12 11\nf 8 5 9 12\n",
                 ", land: [terrain]");
    return std::ranges::any_of(built.warnings, [](const std::string& warning) {
      return warning.find("1 object lies wholly below the land: house by 3") != warning.npos ||
             warning.find("wholly inside") != warning.npos;
    });
  };
  EXPECT_TRUE(is_told("-9", "-3"));
  EXPECT_FALSE(is_told("-6", "1"));
  EXPECT_FALSE(is_told("-6", "-0.2"));  // land is drawn to decimetres
}

/// Were the steep bank a wall, made ground would lie in its place as well.
TEST(SceneLand, IsGroundHoweverSteep) {
  constexpr double wide_m = 100, margin_m = 20, rounding_m2 = 1e-6;
  const BuiltScene built = scene_of(WorkFolder(),
                                    "o land\nv 0 0 0\nv 50 0 0\nv 51 0 10\nv 100 0 10\n"
                                    "v 0 100 0\nv 50 100 0\nv 51 100 10\nv 100 100 10\n"
                                    "f 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\n",
                                    ", land: [land], ground: {margin_m: 20}");
  EXPECT_EQ(built.report.area_m2[static_cast<std::size_t>(Surface::wall)], 0);
  ASSERT_TRUE(built.report.ground);
  EXPECT_NEAR(built.report.ground->terrain_m2, wide_m * wide_m, rounding_m2);
  EXPECT_NEAR(built.report.ground->made_m2, std::pow(wide_m + 2 * margin_m, 2) - wide_m * wide_m,
              rounding_m2);
}

}  // namespace
}  // namespace sunload::test
