// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Several files in one scene, each with its own units and place.

#include "io/plan/scene_models.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geo/base/units.h"
#include "geo/sun/site.h"
#include "io/plan/scene_build.h"
#include "tests/support/paths.h"
#include "tests/support/refusal_of.h"
#include "tests/support/work_folder.h"

namespace sunload::test {
namespace {

/// An L in the plane: its corners tell every turn and mirror image.
constexpr const char* sheet = "o sheet\nv 0 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\n";

class Files : public testing::Test {
 protected:
  Files() {
    folder_.write("a.obj", sheet);
    folder_.write("b.obj", sheet);
  }
  Study study(const std::string& files,
              const std::string& site = "latitude_deg: 50, longitude_deg: 14",
              const std::string& repair = "none") const {
    return read_study(folder_.write("s.yaml",
                                    "format: sunload-study-1\nname: s\nsite: {timezone: UTC, " +
                                        site + "}\nperiod: {days: [2026-03-21]}\nscene: {repair: " +
                                        repair + ", files: [" + files + "]}\n"))
        .variants.front();
  }
  PolygonModel model(const std::string& files) const { return read_models(study(files)); }
  std::string refusal(const std::string& files, const std::string& site) const {
    return refusal_of([&] { read_models(study(files, site)); });
  }
  WorkFolder folder_;
};

void expect_at(Vec3 found, Vec3 expected) {
  for (const auto& [a, b] :
       {std::pair{found.x, expected.x}, {found.y, expected.y}, {found.z, expected.z}})
    EXPECT_NEAR(a, b, 1e-12 * (1 + std::abs(b)));  // two products and a sum
}

TEST_F(Files, StandWhereTheStudyPutsThem) {
  const auto m = model("a.obj, {file: b.obj, position_m: [10, 20, 30], turn_deg: 90, unit_m: 0.5}");
  ASSERT_EQ(m.vertices.size(), 6u);
  EXPECT_EQ(m.vertices[1], (Vec3{2, 0, 0}));
  EXPECT_EQ(m.vertices[3], (Vec3{10, 20, 30}));
  EXPECT_EQ(m.vertices[4], (Vec3{10, 19, 30}));    // +x goes to -y: clockwise from above, exactly
  EXPECT_EQ(m.vertices[5], (Vec3{10.5, 20, 30}));  // +y to +x
  EXPECT_EQ(m.facts.size(), 2u);
}

double area_of(const BuiltScene& built) {
  double sum = 0;
  for (std::size_t t = 0; t < built.scene.mesh.triangle_count(); ++t)
    sum += built.scene.mesh.area_m2(t);
  return sum;
}

// The triangle has 1 m2; the second of two files lies in the first, but for a strip of 0.75 m2.
TEST_F(Files, AreLeftOutWhereTheyLieInOneAnother) {
  const std::string site = "latitude_deg: 50, longitude_deg: 14",
                    files = "a.obj, {file: b.obj, position_m: [1, 0, 0]}";
  const BuiltScene built = build_scene(study(files, site, "safe"));
  EXPECT_NEAR(area_of(built), 1.75, 1e-12);
  const auto says = [](const BuiltScene& of, const std::string& text) {
    return std::any_of(of.warnings.begin(), of.warnings.end(), [&](const std::string& warning) {
      return warning.find(text) != std::string::npos;
    });
  };
  EXPECT_TRUE(says(built,
                   "0.25 m2 that lie in other surfaces and face the same way are left out "
                   "(first sheet_2 in sheet)"));
  EXPECT_FALSE(says(built, "receive the light of one"));
  const BuiltScene as_read = build_scene(study(files, site, "none"));
  EXPECT_NEAR(area_of(as_read), 2, 1e-12);
  EXPECT_TRUE(says(as_read, "0.25 m2 lie in other surfaces that face the same way"));
}

TEST_F(Files, TurnAsAzimuthsDo) {
  const auto m = model("{file: a.obj, turn_deg: 30}");
  // The file's +y axis points to the azimuth 30 degrees, at the scene's north_deg 0.
  expect_at(m.vertices[2], enu_direction({30, 0}));
  const auto back = model("{file: a.obj, turn_deg: -30}");
  expect_at(back.vertices[2], enu_direction({330, 0}));
}

TEST_F(Files, HaveAxesOfTheirOwn) {
  const auto m = model("a.obj, {file: b.obj, up: y, position_m: [0, 0, 5]}");
  EXPECT_EQ(m.vertices[2], (Vec3{0, 1, 0}));
  EXPECT_EQ(m.vertices[5], (Vec3{0, 0, 6}));
}

TEST_F(Files, KeepObjectsOfOneNameApart) {
  const auto m =
      model("a.obj, {file: b.obj, position_m: [10, 0, 0]}, {file: b.obj, position_m: [20, 0, 0]}");
  EXPECT_EQ(m.object_names, (std::vector<std::string>{"sheet", "sheet_2", "sheet_3"}));
  EXPECT_EQ(std::count_if(m.notes.begin(), m.notes.end(),
                          [](const std::string& note) {
                            return note.find(
                                       "b.obj: 1 object is named as in an earlier file, kept "
                                       "apart: 'sheet' is 'sheet_") != std::string::npos;
                          }),
            2);
}

TEST_F(Files, StandAtALatitudeAndLongitudeOfTheScenesCrs) {
  // The middle of a house in Delft, on the Dutch grid, there and back.
  const Vec3 place{85000, 447000, 3};
  const Site there = site_from_crs("EPSG:28992", place);
  const Vec3 back = map_position("EPSG:28992", there.latitude_deg, there.longitude_deg, 3);
  EXPECT_NEAR(back.x, place.x, 1e-3);  // the shift of datum at height 0 is no exact inverse
  EXPECT_NEAR(back.y, place.y, 1e-3);
  EXPECT_EQ(back.z, 3);
  const auto text = std::to_string(there.latitude_deg) + " " + std::to_string(there.longitude_deg);
  const std::string file = "{file: a.obj, position: \"" + text + "\", height_m: 3}";
  const auto m = read_models(study(file, "crs: EPSG:28992"));
  EXPECT_NEAR(m.vertices[0].x, place.x, 0.1);  // six decimals of a degree
  EXPECT_NEAR(m.vertices[0].y, place.y, 0.1);
  EXPECT_EQ(m.vertices[0].z, 3);
  EXPECT_NE(refusal(file, "latitude_deg: 52, longitude_deg: 4").find("needs the scene's CRS"),
            std::string::npos);
}

TEST_F(Files, WaitForTheCrsOfAnotherFile) {
  const auto city = source_folder() + "/configs/models/town.city.json";
  const auto built = build_scene(study("{file: a.obj, position: \"49.7480 13.3770\"}, " + city));
  EXPECT_NE(built.site_source.find("25833"), std::string::npos) << built.site_source;
  const Vec3 size = built.report.bounds.high - built.report.bounds.low;
  EXPECT_LT(size.x, 5000);  // both in the town
  EXPECT_LT(size.y, 5000);
  const auto moved = build_scene(study("{file: " + city + ", position_m: [0, 0, 0]}"));
  EXPECT_EQ(moved.site_source, "position from the study");
  EXPECT_TRUE(std::any_of(moved.notes.begin(), moved.notes.end(), [](const std::string& note) {
    return note.find("its own CRS is not used") != std::string::npos;
  }));
}

/// Area and volume of closed bodies do not change where they are turned and moved.
/// A face that rises by 6 from (x, 5000000), of a system.
std::string city_face(const std::string& crs, const std::string& x = "500000") {
  return R"({"type": "CityJSON", "version": "1.1", "metadata": {"referenceSystem": ")" + crs +
         R"("}, "transform": {"scale": [1, 1, 1], "translate": [)" + x + R"(, 5000000, 0]},
  "CityObjects": {"wall": {"type": "Building", "geometry": [{"type": "MultiSurface", "lod": "1",
    "boundaries": [[[0, 1, 2, 3]]]}]}},
  "vertices": [[0, 0, 0], [10, 0, 0], [10, 0, 6], [0, 0, 6]]})";
}

TEST_F(Files, HaveHeightsInTheUnitOfTheirCrs) {
  constexpr double survey_foot_m = 1200.0 / 3937;
  const auto height = [&](const std::string& crs, const std::string& unit) {
    folder_.write("wall.city.json", city_face(crs));
    const auto m = model("{file: wall.city.json, unit_m: " + unit + "}");
    return m.vertices[2].z - m.vertices[1].z;
  };
  constexpr double rounding = 1e-6;  // of the unit that PROJ has
  EXPECT_NEAR(height("EPSG:26918", "1"), 6, rounding);
  EXPECT_NEAR(height("EPSG:26918+6360", "1"), 6 * survey_foot_m, rounding);
  // Of a map in feet, which the study makes metres of, heights are in metres, too.
  EXPECT_NEAR(height("EPSG:2263+5703", "0.3048006096012192"), 6, rounding);
  EXPECT_NEAR(height("EPSG:2263+6360", "0.3048006096012192"), 6 * survey_foot_m, rounding);
  // The study's word against the file's.
  EXPECT_NEAR(height("EPSG:26918+6360", "0.5"), 3, rounding);
}

TEST_F(Files, BelongTogetherWithAndWithoutHeights) {
  folder_.write("flat.city.json", city_face("EPSG:28992"));
  folder_.write("high.city.json", city_face("EPSG:7415", "500020"));
  folder_.write("other.city.json", city_face("EPSG:25832"));
  EXPECT_EQ(model("flat.city.json, high.city.json").facts.size(), 2u);
  EXPECT_NE(refusal("flat.city.json, other.city.json", "latitude_deg: 50, longitude_deg: 14"), "");
  const auto m = read_models(study("flat.city.json, other.city.json", "crs: 'EPSG:28992'"));
  EXPECT_TRUE(std::ranges::any_of(m.notes, [](const std::string& note) {
    return note.find("EPSG:25832, taken for EPSG:28992 by site.crs") != std::string::npos;
  }));
}

TEST_F(Files, KeepTheirShapeInEveryPlace) {
  folder_.write("box.obj",
                "o box\nv 0 0 0\nv 2 0 0\nv 2 3 0\nv 0 3 0\nv 0 0 4\nv 2 0 4\nv 2 3 4\nv 0 3 4\n"
                "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  const auto built =
      build_scene(study("{file: box.obj, position_m: [91000, 435000, 2], turn_deg: 17}"));
  EXPECT_EQ(built.report.closed_bodies, 1u);
  EXPECT_NEAR(built.report.volume_m3, 24, 24 * 1e-9);  // a grid coordinate rounds at 1e-11 m
  EXPECT_NEAR(built.scene.mesh.facades.at(0).azimuth_deg, 17, 1e-6);
}

}  // namespace
}  // namespace sunload::test
