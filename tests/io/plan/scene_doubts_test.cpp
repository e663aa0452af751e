// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Warnings of scenes that are hardly what was meant.

#include "io/plan/scene_doubts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "io/plan/light_series.h"
#include "tests/support/refusal_of.h"
#include "tests/support/work_folder.h"

namespace sunload::test {
namespace {

class Doubts : public testing::Test {
 protected:
  Study study(const std::string& scene, const std::string& site = "",
              const std::string& day = "2026-03-21") const {
    return read_study(folder_.write("s.yaml",
                                    "format: sunload-study-1\nname: s\nsite: {latitude_deg: 52, "
                                    "longitude_deg: 4.4, timezone: UTC" +
                                        site + "}\nperiod: {days: [" + day + "]}\nscene: {" +
                                        scene + "}\n"))
        .variants.front();
  }
  bool warns(const Study& of, const std::string& what) const {
    const auto warnings = build_scene(of).warnings;
    return std::any_of(warnings.begin(), warnings.end(), [&](const std::string& warning) {
      return warning.find(what) != std::string::npos;
    });
  }
  /// Boxes of an OBJ file with feet at z = 0, or turned so that y is up.
  void write_town(const std::string& name, bool y_up) const {
    std::string text;
    int first = 1;
    for (int house = 0; house < 4; ++house) {
      const double x = 12.0 * house, y = 7.0 * (house % 3), h = 5 + house;
      text += "o house_" + std::to_string(house) + "\n";
      for (const double z : {0.0, h})
        for (const auto& [a, b] :
             {std::pair{x, y}, {x + 10, y + 2}, {x + 8, y + 12}, {x - 2, y + 10}})
          text += "v " + std::to_string(a) + " " +
                  (y_up ? std::to_string(z) + " " + std::to_string(-b)
                        : std::to_string(b) + " " + std::to_string(z)) +
                  "\n";
      const auto face = [&](std::initializer_list<int> corners) {
        text += "f";
        for (const int c : corners) text += " " + std::to_string(first + c);
        text += "\n";
      };
      face({3, 2, 1, 0});
      face({4, 5, 6, 7});
      for (int k = 0; k < 4; ++k) face({k, (k + 1) % 4, 4 + (k + 1) % 4, 4 + k});
      first += 8;
    }
    folder_.write(name, text);
  }
  WorkFolder folder_;
};

constexpr const char* lies = "lie on its side";

TEST_F(Doubts, AModelInMillimetresIsTold) {
  write_town("town.obj", false);
  const std::string what = "higher than any house";
  EXPECT_FALSE(warns(study("files: [town.obj]"), what));
  EXPECT_TRUE(warns(study("files: [{file: town.obj, unit_m: 1000}]"), "house_3 is 8000 m high"));
  EXPECT_FALSE(warns(study("files: [{file: town.obj, unit_m: 100}]"), what));
}

TEST_F(Doubts, SeeATownThatLiesOnItsSide) {
  write_town("up_z.obj", false);
  write_town("up_y.obj", true);
  EXPECT_FALSE(warns(study("files: [up_z.obj], up: z"), lies));
  EXPECT_TRUE(warns(study("files: [up_y.obj], up: z"), lies));
  EXPECT_FALSE(warns(study("files: [up_y.obj], up: y"), lies));
}

TEST_F(Doubts, NameTheAxisOfTheFile) {
  write_town("up_z.obj", false);
  write_town("up_y.obj", true);
  EXPECT_TRUE(warns(study("files: [up_y.obj]"), "scene.up: y"));
  EXPECT_TRUE(warns(study("files: [up_z.obj], up: y"), "scene.up: z"));
  EXPECT_TRUE(warns(study("files: [up_z.obj], up: x"), "scene.up: z"));
  EXPECT_TRUE(warns(study("files: [up_y.obj], up: x"), "scene.up: y"));
  EXPECT_TRUE(warns(study("files: [{file: up_y.obj, up: z}, {file: up_z.obj, up: x}]"),
                    "up of each of scene.files"));
}

TEST_F(Doubts, SeeLandThatStandsUpright) {
  folder_.write("land.obj",
                "v 0 0 0\nv 9 0 0\nv 9 0 9\nv 0 0 9\nf 1 4 3 2\n"
                "v 3 0 3\nv 5 0 3\nv 5 4 3\nv 3 4 3\nf 5 6 7 8\n");
  EXPECT_TRUE(warns(study("files: [land.obj], up: z"), lies));
  EXPECT_FALSE(warns(study("files: [land.obj], up: y"), lies));
}

/// A block and the land about it in one sheet, whose walls have more area than its level faces.
TEST_F(Doubts, SeeHousesAndTheirLandInOneSheet) {
  folder_.write("sheet.obj",
                "v 3 0 6\nv 6 0 6\nv 6 0 3\nv 3 0 3\nv 3 12 6\nv 6 12 6\nv 6 12 3\nv 3 12 3\n"
                "v 0 0 9\nv 9 0 9\nv 9 0 0\nv 0 0 0\n"
                "f 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"
                "f 9 10 2 1\nf 10 11 3 2\nf 11 12 4 3\nf 12 9 1 4\n");
  EXPECT_TRUE(warns(study("files: [sheet.obj], up: z"), lies));
  EXPECT_FALSE(warns(study("files: [sheet.obj], up: y"), lies));
}

TEST_F(Doubts, LeaveSlabsAndFacadesAlone) {
  for (const char* scene : {"street", "skyscrapers", "windows", "canyon", "city", "box_on_plane"})
    EXPECT_FALSE(warns(study(std::string("builtin: {name: ") + scene + "}"), lies)) << scene;
  folder_.write("wall.obj", "v 0 0 0\nv 9 0 0\nv 9 0 9\nv 0 0 9\nf 1 2 3 4\n");
  EXPECT_FALSE(warns(study("files: [wall.obj], up: z, ground: {margin_m: 5}"), lies));
}

TEST_F(Doubts, SeeSensorsWithinBodies) {
  write_town("town.obj", false);
  const auto inside = [&](const std::string& positions, const std::string& more = "") {
    std::string points;
    for (const char at : positions)
      points += std::string(points.empty() ? "" : ", ") + "{position_m: " +
                (at == 'i'   ? "[4, 6, 2.5]"
                 : at == 'r' ? "[4, 6, 5.5]"
                             : "[-5, 6, 1.5]") +
                ", normal: [0, 0, 1]}";
    return warns(study("files: [town.obj]" + more + "}\nsensors: {points: [" + points + "]"),
                 "sensors lie within bodies, the first of them sensor 1");
  };
  EXPECT_TRUE(inside("oi"));
  EXPECT_TRUE(inside("ri", ", ground: {}"));
  EXPECT_FALSE(inside("or"));
  // A canopy or a crown lets light through.
  EXPECT_FALSE(inside("oi",
                      ", materials: {net: {transmittance: 0.5}}, assign: [{object: '*', "
                      "material: net}]"));
}

TEST_F(Doubts, NotePanesThatAreLitFromBothSides) {
  write_town("town.obj", false);
  folder_.write("canopy.obj", "o canopy\nv -20 0 3\nv -14 0 3\nv -14 4 3\nv -20 4 3\nf 1 2 3 4\n");
  const auto notes = [&](const std::string& glass) {
    std::string all;
    for (const auto& note :
         build_scene(study("files: [town.obj, canopy.obj], materials: {glass: {refractive_index: "
                           "1.526" +
                           glass + "}}, assign: [{object: canopy, material: glass}]"))
             .notes)
      all += note + "\n";
    return all;
  };
  const auto open = notes(", sides: two");
  EXPECT_NE(open.find("panes (glass) of 24 m2 are lit from both sides"), std::string::npos) << open;
  EXPECT_EQ(notes("").find("lit from both sides"), std::string::npos);
}

/// Panels look where they are told, whatever north of the scene is.
TEST_F(Doubts, SensorsMayBeTilted) {
  write_town("town.obj", false);
  const auto normal = [&](const std::string& looks, const std::string& north) {
    const Study of =
        study("files: [town.obj]}\nsensors: {points: [{position_m: [-5, 6, 1.5], " + looks + "}]",
              ", north_deg: " + north);
    return build_scene(of).scene.sensors.front().normal;
  };
  constexpr double rounding = 1e-12;
  const Vec3 south = normal("tilt_deg: 30, azimuth_deg: 180", "0");
  EXPECT_LT(norm(south - Vec3{0, -0.5, std::sqrt(0.75)}), rounding);
  // +y points east: south is +x.
  EXPECT_LT(norm(normal("tilt_deg: 90, azimuth_deg: 180", "90") - Vec3{1, 0, 0}), rounding);
  EXPECT_LT(norm(normal("tilt_deg: 0", "90") - Vec3{0, 0, 1}), rounding);
  EXPECT_LT(norm(normal("tilt_deg: 150, azimuth_deg: 0", "0") + south), rounding);
  const auto refused = [&](const std::string& looks, const char* said) {
    const std::string text = refusal_of([&] { normal(looks, "0"); });
    EXPECT_NE(text.find(said), std::string::npos) << text;
  };
  refused("tilt_deg: 30", "azimuth_deg");
  refused("azimuth_deg: 30", "tilt_deg");
  refused("tilt_deg: 190, azimuth_deg: 0", "tilt_deg");
  refused("tilt_deg: 30, azimuth_deg: 0, normal: [0, 0, 1]", "they say the same");
  refused("", "normal is missing");
}

TEST_F(Doubts, CompareNorthWithTheMap) {
  SiteStudy given;
  given.north_deg = 0;
  EXPECT_EQ(north_warning(given, "EPSG:28992", 0.4), "");
  EXPECT_EQ(north_warning(given, "EPSG:28992", 359.7), "");
  EXPECT_EQ(north_warning({}, "EPSG:28992", 5), "");
  EXPECT_NE(north_warning(given, "EPSG:28992", -0.8).find("puts north at -0.8"), std::string::npos);
}

/// A city of one house whose appearance paints its walls.
std::string painted_house(const std::string& colour) {
  return R"({"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],"translate":[0,0,0]},
"appearance":{"materials":[{"name":"paint","diffuseColor":)" +
         colour + R"(}]},
"CityObjects":{"house":{"type":"Building","geometry":[{"type":"MultiSurface","lod":"2",
"boundaries":[[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]],[[4,5,6,7]]],
"material":{"visual":{"values":[0,0,0,0,0]}}}]}},
"vertices":[[0,0,0],[9,0,0],[9,9,0],[0,9,0],[0,0,6],[9,0,6],[9,9,6],[0,9,6]]})";
}

TEST_F(Doubts, TellOfColoursThatBecomeReflectances) {
  folder_.write("house.city.json", painted_house("[0.92,0.92,0.92]"));
  const std::string files = "files: [house.city.json]";
  EXPECT_TRUE(
      warns(study(files), "taken as reflectances: wall 0.92 (table: brick 0.3), roof 0.92"));
  EXPECT_TRUE(warns(study(files), "walls reflect 0.92 of the light"));
  // What the study says is no colour, and bright walls are told once more.
  const std::string said = files + ", materials: {paint: {diffuse: 0.92}}";
  EXPECT_FALSE(warns(study(said), "taken as reflectances"));
  EXPECT_TRUE(warns(study(said), "walls reflect 0.92 of the light"));
  const std::string ruled = files +
                            ", assign: [{surface: wall, material: brick}, {surface: roof, "
                            "material: roof_tile}]";
  EXPECT_FALSE(warns(study(ruled), "taken as reflectances"));
  EXPECT_FALSE(warns(study(ruled), "walls reflect"));
}

/// Behind the table UT1 is known to 0.9 s, 0.004 degrees, as long as there are leap seconds.
TEST_F(Doubts, TellOfTheEarthsTurnOnlyWhereItMatters) {
  const auto notes = [&](const std::string& day) {
    const Study of = study("builtin: {name: box_on_plane}", "", day);
    std::string text;
    for (const auto& note : light_series(of, build_scene(of).site).notes) text += note + "\n";
    return text;
  };
  EXPECT_EQ(notes("2029-03-21").find("UT1"), std::string::npos);
  EXPECT_NE(notes("2060-03-21").find("UT1"), std::string::npos);
}

}  // namespace
}  // namespace sunload::test
