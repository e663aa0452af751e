// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Plan data becomes closed buildings of the heights that its columns say.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "geo/sun/site.h"
#include "tests/support/plan_file.h"
#include "tests/support/refusal_of.h"
#include "tests/support/scene_text.h"

namespace sunload {
namespace {

using namespace sunload::test;

constexpr const char* utm33 =
    R"("crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::32633"}}, )";

std::string feature(const std::string& properties, const std::string& rings,
                    const std::string& type = "Polygon") {
  return R"({"type": "Feature", "properties": {)" + properties + R"(}, "geometry": {"type": ")" +
         type + R"(", "coordinates": )" + rings + "}}";
}

std::string square(double x, double y, double size) {
  return fmt::format("[[{0}, {1}], [{2}, {1}], [{2}, {3}], [{0}, {3}], [{0}, {1}]]", x, y, x + size,
                     y + size);
}

std::string plan(const std::vector<std::string>& features, const std::string& crs = utm33) {
  return R"({"type": "FeatureCollection", )" + crs + R"("features": [)" +
         fmt::format("{}", fmt::join(features, ", ")) + "]}";
}

/// Heights of an object's lowest and highest corner.
std::pair<double, double> extent(const PolygonModel& model, std::size_t object) {
  double low = 1e300, high = -1e300;
  for (std::size_t p = 0; p < model.polygon_count(); ++p) {
    if (model.facts[p].object.index() != object) continue;
    for (auto r = model.polygon_ring[p]; r < model.polygon_ring[p + 1]; ++r)
      for (auto k = model.ring_begin[static_cast<std::size_t>(r)];
           k < model.ring_begin[static_cast<std::size_t>(r) + 1]; ++k) {
        const double z =
            model.vertices[static_cast<std::size_t>(model.ring_vertex[static_cast<std::size_t>(k)])]
                .z;
        low = std::min(low, z);
        high = std::max(high, z);
      }
  }
  return {low, high};
}

TEST(Footprints, AreBuildingsOfTheirHeights) {
  const auto model = read_text(
      "plan.geojson",
      plan({feature(R"("name": "town hall", "height": 12.5)",
                    "[" + square(500000, 5500000, 20) + ", " + square(500005, 5500005, 5) + "]"),
            feature(R"("name": "sheds", "height": "4 m")",
                    "[[" + square(500050, 5500000, 5) + "], [" + square(500060, 5500000, 5) + "]]",
                    "MultiPolygon")}));
  EXPECT_EQ(model.object_names, (std::vector<std::string>{"town hall", "sheds"}));
  EXPECT_EQ(model.object_kinds, (std::vector<std::string>{"Building", "Building"}));
  EXPECT_EQ(model.crs, "EPSG:32633");
  EXPECT_TRUE(model.is_city_format);
  EXPECT_EQ(extent(model, 0), (std::pair{0.0, 12.5}));
  EXPECT_EQ(extent(model, 1), (std::pair{0.0, 4.0}));
  EXPECT_EQ(model.polygon_count(), (4u + 4 + 2) + 2 * (4u + 2));  // walls, those of the court, lids
  EXPECT_TRUE(has_note(model, "heights of footprints from column height"));
  EXPECT_EQ(broken_arrays(model), "");
}

TEST(Footprints, HaveStoreysADefaultAndFeet) {
  SceneFileRules rules;
  rules.footprints.height = "h";
  rules.footprints.storeys = "n";
  rules.footprints.base = "z";
  rules.footprints.name = "id";
  rules.footprints.storey_m = 3.5;
  rules.footprints.default_height_m = 9;
  const auto model = read_text(
      "plan.geojson",
      plan({feature(R"("id": 7, "h": null, "n": 2, "z": 100)", "[" + square(0, 0, 9) + "]"),
            feature(R"("id": 7, "h": 0, "n": null, "z": 101)", "[" + square(20, 0, 9) + "]"),
            feature(R"("id": 8, "h": 5, "n": 9, "z": 102)", "[" + square(40, 0, 9) + "]")}),
      rules);
  EXPECT_EQ(model.object_names, (std::vector<std::string>{"7", "7_2", "8"}));
  EXPECT_EQ(extent(model, 0), (std::pair{100.0, 107.0}));
  EXPECT_EQ(extent(model, 1), (std::pair{101.0, 110.0}));
  EXPECT_EQ(extent(model, 2), (std::pair{102.0, 107.0}));
}

/// OpenStreetMap has heights of some buildings and storeys of others.
TEST(Footprints, WithoutAHeightTakeStoreysOfTheUsualNames) {
  const std::string text =
      plan({feature(R"("height": 8, "building:levels": 9)", "[" + square(0, 0, 9) + "]"),
            feature(R"("building:levels": 2)", "[" + square(20, 0, 9) + "]")});
  const auto found = read_text("plan.geojson", text);
  EXPECT_EQ(extent(found, 0), (std::pair{0.0, 8.0}));
  EXPECT_EQ(extent(found, 1), (std::pair{0.0, 6.0}));
  SceneFileRules rules;
  rules.footprints.height = "height";
  EXPECT_EQ(extent(read_text("plan.geojson", text, rules), 1), (std::pair{0.0, 6.0}));
}

TEST(Footprints, InDegreesAreProjected) {
  const auto model = read_text("plan.json", plan({feature(R"("height": 10)",
                                                          "[[[15.001, 49.6535], [15.002, 49.6535], "
                                                          "[15.002, 49.654], [15.001, 49.6535]]]")},
                                                 ""));
  EXPECT_EQ(model.crs, "EPSG:32633");
  const Vec3 expected = map_position("EPSG:32633", 49.6535, 15.001, 0);
  const bool is_there = std::any_of(model.vertices.begin(), model.vertices.end(), [&](Vec3 v) {
    return std::hypot(v.x - expected.x, v.y - expected.y) < 0.001;  // both by PROJ
  });
  EXPECT_TRUE(is_there);
}

/// What a GeoPackage says of its extent may be that of a country, or of another place.
TEST(Footprints, LieWhereTheirPolygonsDo) {
  const WorkFolder folder;
  const std::string source = folder.write(
      "plan.geojson", plan({feature(R"("height": 10)",
                                    "[[[174.780, -41.29], [174.781, -41.29], [174.781, -41.289], "
                                    "[174.780, -41.29]]]")},
                           ""));
  for (const char* extent : {"min_x = 100, max_x = 100.1", "min_x = 166, max_x = 179",
                             "min_x = -180, max_x = 180", "min_x = NULL, max_x = NULL"}) {
    const std::string path = folder / "plan.gpkg";
    std::filesystem::remove(path);
    ASSERT_TRUE(write_plan(source, "GPKG", path));
    ASSERT_TRUE(change_plan(path, fmt::format("UPDATE gpkg_contents SET {}", extent)));
    EXPECT_EQ(read_scene_file(path, {}).crs, "EPSG:32760") << extent;
  }
}

TEST(Footprints, StandOnTheLowestLandBelowThem) {
  const WorkFolder folder;
  SceneFileRules rules;
  rules.footprints.terrain = folder.write(
      "land.asc", "ncols 2\nnrows 2\nxllcorner -5\nyllcorner -5\ncellsize 10\n10 20\n10 20\n");
  const auto model = read_text(
      "plan.geojson", plan({feature(R"("height": 10)", "[" + square(2, 2, 6) + "]")}), rules);
  EXPECT_EQ(extent(model, 0), (std::pair{12.0, 22.0}));  // 10 m at x = 0, 20 m at 10
  const std::string refused = refusal_of([&] {
    read_text("plan.geojson", plan({feature(R"("height": 10)", "[" + square(90, 2, 6) + "]")}),
              rules);
  });
  EXPECT_NE(refused.find("lies outside of the terrain"), std::string::npos) << refused;
}

TEST(Footprints, StandOnLandAboutThemWhereThereIsNoneBelow) {
  const WorkFolder folder;
  SceneFileRules rules;
  std::string grid =
      "ncols 5\nnrows 5\nxllcorner 0\nyllcorner 0\ncellsize 10\nnodata_value -9999\n";
  for (int r = 0; r < 5; ++r)
    for (int c = 0; c < 5; ++c)
      grid += fmt::format("{} ", r > 0 && r < 4 && c > 0 && c < 4 ? -9999 : 10 * c);
  rules.footprints.terrain = folder.write("land.asc", grid);
  const auto model = read_text(
      "plan.geojson", plan({feature(R"("height": 10)", "[" + square(20, 20, 10) + "]")}), rules);
  EXPECT_EQ(extent(model, 0), (std::pair{15.0, 25.0}));  // 20 m at x = 25, the middle
  EXPECT_TRUE(has_note(model, "9 cells without data in the terrain are filled"));
}

TEST(Footprints, SayWhatIsMissing) {
  const std::string ring = "[" + square(0, 0, 9) + "]";
  FootprintRules tall, layer_b;
  tall.height = "tall";
  layer_b.layer = "b";
  struct Wrong {
    std::string text;
    FootprintRules rules;
    const char* expected;
  };
  for (const Wrong& wrong :
       {Wrong{plan({feature(R"("use": "barn")", ring)}), {}, "no column of heights is known"},
        Wrong{plan({feature(R"("use": "barn")", ring)}), {}, "its columns: use"},
        Wrong{plan({feature(R"("use": "barn")", ring)}), tall, "has no column 'tall'"},
        Wrong{plan({feature(R"("id": "a", "height": 3)", ring),
                    feature(R"("id": "b", "height": null)", ring)}),
              {},
              "1 of 2 footprints have no height above 0 (b)"},
        Wrong{plan({feature(R"("height": 5000)", ring)}), {}, "5000 m high"},
        Wrong{plan({feature(R"("height": 5)", "[1, 2]", "Point")}), {}, "has no "},
        Wrong{plan({feature(R"("height": 5)", ring)}), layer_b, "has no layer 'b'"},
        Wrong{R"({"type": "FeatureCollection", "features": [)",
              {},
              "cannot be read as footprints"}}) {
    SceneFileRules rules;
    rules.footprints = wrong.rules;
    const std::string refused = refusal("plan.geojson", wrong.text, rules);
    EXPECT_NE(refused.find(wrong.expected), std::string::npos) << wrong.expected << "\n" << refused;
  }
}

/// The same plan in the files of GDAL's drivers.
TEST(Footprints, OfEveryFormatAreTheSame) {
  const WorkFolder folder;
  const std::string text =
      plan({feature(R"("name": "a", "height": 7)", "[" + square(500000, 5500000, 9) + "]"),
            feature(R"("name": "b", "height": 8)", "[" + square(500020, 5500000, 9) + "]")});
  const std::string source = folder.write("plan.geojson", text);
  const auto expected = read_scene_file(source, {});
  for (const auto& [driver, name] :
       {std::pair{"GPKG", "plan.gpkg"}, {"ESRI Shapefile", "plan.shp"}}) {
    const std::string path = folder / name;
    ASSERT_TRUE(write_plan(source, driver, path)) << driver;
    const auto model = read_scene_file(path, {});
    EXPECT_EQ(model.object_names, expected.object_names) << driver;
    EXPECT_EQ(model.vertices.size(), expected.vertices.size()) << driver;
    EXPECT_EQ(extent(model, 1), (std::pair{0.0, 8.0})) << driver;
    EXPECT_EQ(model.crs, "EPSG:32633") << driver;
  }
}

TEST(Footprints, HeightsThatAreNoNumbersAreTold) {
  SceneFileRules rules;
  rules.footprints.default_height_m = 6;
  const auto model =
      read_text("plan.geojson",
                plan({feature(R"("height": "~15")", "[" + square(500000, 5500000, 5) + "]"),
                      feature(R"("height": "40 ft")", "[" + square(500010, 5500000, 5) + "]"),
                      feature(R"("height": "30'")", "[" + square(500020, 5500000, 5) + "]"),
                      feature(R"("height": 0)", "[" + square(500030, 5500000, 5) + "]"),
                      feature(R"("height": " 8 ")", "[" + square(500040, 5500000, 5) + "]")}),
                rules);
  const double heights[] = {6, 40 * 0.3048, 30 * 0.3048, 6, 8};
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(extent(model, k).second, heights[k], 1e-9) << k;
  EXPECT_TRUE(has_note(model, "2 of 5 footprints have no height above 0 and are 6 m high"));
  EXPECT_TRUE(has_note(model,
                       "1 values of heights, storeys or feet are no numbers, such as '~15': they "
                       "count as not written"));
}

TEST(Footprints, HeightsMayHaveADecimalCommaOrInches) {
  const std::string ring = "[" + square(500000, 5500000, 5) + "]";
  const auto high = [&](const std::string& height) {
    SceneFileRules rules;
    rules.footprints.default_height_m = 6;
    return extent(read_text("plan.geojson", plan({feature("\"height\": \"" + height + "\"", ring)}),
                            rules),
                  0)
        .second;
  };
  EXPECT_NEAR(high("12,5"), 12.5, 1e-9);
  EXPECT_NEAR(high("12,25 m"), 12.25, 1e-9);
  EXPECT_NEAR(high(R"(39'6\")"), 39.5 * 0.3048, 1e-9);
  for (const char* unclear : {"1,500", "1,2,3", "1.000,5", "12,", ",5", "39'6", "12,5;13"})
    EXPECT_NEAR(high(unclear), 6, 1e-9) << unclear;
}

TEST(Footprints, ThatAreRefusedShowWhatIsWritten) {
  const std::string ring = "[" + square(0, 0, 9) + "]";
  const std::string refused =
      refusal("plan.geojson",
              plan({feature(R"("id": "a", "height": "~15", "levels": "4;5")", ring),
                    feature(R"("id": "b", "height": null, "levels": "3,4")", ring),
                    feature(R"("id": "c", "height": 0)", ring)}),
              {});
  EXPECT_NE(refused.find("3 of 3 footprints have no height above 0 (a: '4;5', b: '3,4', c) (what "
                         "is written there is no number, nor one with m, ft or ')"),
            std::string::npos)
      << refused;
}

TEST(Footprints, OfPartsMayBeginAboveTheGround) {
  const std::string ring = "[" + square(500000, 5500000, 5) + "]";
  const auto model = read_text(
      "plan.geojson",
      plan({feature(R"("name": "a", "height": 20, "min_height": "6 m", "building:min_level": 1)",
                    ring),
            feature(R"("name": "b", "height": 20, "building:min_level": "2")", ring),
            feature(R"("name": "c", "height": 20, "min_height": 0)", ring)}));
  EXPECT_EQ(extent(model, 0), (std::pair{6.0, 20.0}));
  EXPECT_EQ(extent(model, 1), (std::pair{6.0, 20.0}));
  EXPECT_EQ(extent(model, 2), (std::pair{0.0, 20.0}));
  EXPECT_TRUE(model.warnings.empty());
}

TEST(Footprints, ThatBeginNoLowerThanTheyEndAreToldOf) {
  const std::string ring = "[" + square(500000, 5500000, 5) + "]";
  const auto model = read_text(
      "plan.geojson", plan({feature(R"("name": "a", "height": 6, "min_height": 20)", ring),
                            feature(R"("name": "b", "height": 6, "min_height": 3)", ring)}));
  EXPECT_EQ(extent(model, 0), (std::pair{0.0, 6.0}));
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_NE(model.warnings.front().find("1 of 2 footprints begin no lower than they end, by "
                                        "min_height or building:min_level (a from 20 to 6 m)"),
            std::string::npos)
      << model.warnings.front();
}

TEST(Footprints, OfNewYorkAreNotTakenForMetres) {
  const std::string ring = "[" + square(0, 0, 9) + "]";
  const std::string refused =
      refusal("plan.geojson", plan({feature(R"("heightroof": 100)", ring)}), {});
  EXPECT_NE(refused.find("its columns: heightroof"), std::string::npos) << refused;
}

TEST(Footprints, InDegreesHaveHeightsInTheStudysUnit) {
  // The land is on its map in metres, whatever the unit of heights.
  const WorkFolder folder;
  SceneFileRules rules;
  rules.unit_m = 0.3048;
  rules.footprints.terrain =
      folder.write("land.asc",
                   "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 5000000\ncellsize 500000\n"
                   "300 300\n300 300\n");
  const auto model =
      read_text("plan.json",
                plan({feature(R"("height": 100)",
                              "[[[15.001, 49.6535], [15.002, 49.6535], [15.002, 49.654], "
                              "[15.001, 49.6535]]]")},
                     ""),
                rules);
  EXPECT_NEAR(extent(model, 0).first, 300, 1e-9);
  EXPECT_NEAR(extent(model, 0).second, 300 + 30.48, 1e-9);
}

/// Walls of an outline that crosses itself would look outward at one end and inward at the other.
TEST(Footprints, OutlinesThatCrossThemselvesAreCut) {
  const auto model = read_text(
      "plan.geojson",
      plan({feature(R"("height": 6)", "[[[0, 0], [20, 0], [0, 20], [20, 20], [0, 0]]]")}));
  EXPECT_EQ(model.object_names.size(), 1u);
  EXPECT_EQ(model.polygon_count(), 2 * 5u);  // two prisms of three walls, a roof and a floor
  EXPECT_TRUE(has_note(model, "1 polygons whose outlines cross or touch themselves are cut there"));
  const auto plain =
      read_text("plan.geojson", plan({feature(R"("height": 6)", "[" + square(0, 0, 9) + "]")}));
  EXPECT_FALSE(has_note(plain, "cut there"));
}

/// A courtyard that is open to the street shares a side with the outline; holes may cross it, or
/// each other. Walls stand about what is left, and nowhere else.
TEST(Footprints, HolesAreTakenOutWhereverTheyReach) {
  const auto walls = [](const std::string& holes) {
    const auto model = read_text(
        "plan.geojson", plan({feature(R"("height": 6)", "[" + square(0, 0, 20) + holes + "]")}));
    return model.polygon_count() - 2;  // without roof and floor
  };
  const std::string open = ", [[10, 14], [20, 14], [20, 6], [10, 6], [10, 14]]";
  EXPECT_EQ(walls(open), 8u);
  EXPECT_EQ(walls(", [[10, 14], [26, 14], [26, 6], [10, 6], [10, 14]]"), 8u) << "beyond it";
  EXPECT_EQ(walls(", " + square(4, 4, 4) + ", " + square(6, 6, 4)), 4u + 8u) << "two that cross";
  EXPECT_EQ(walls(", " + square(30, 4, 4)), 4u) << "outside";
}

}  // namespace
}  // namespace sunload
