// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Inventories of trees: where they stand on the scene's map, how high and wide they are, and what
/// is said where that is not known.
#include "io/scene/raster/tree_points.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/refusal_of.h"
#include "tests/support/work_folder.h"

namespace sunload::test {
namespace {

constexpr const char* utm_33 = "EPSG:32633";

class TreePointFile : public testing::Test {
 protected:
  /// A point of each pair of coordinates and properties.
  std::string geojson(const std::vector<std::pair<const char*, const char*>>& points,
                      const std::string& crs = "") const {
    std::string text = R"({"type": "FeatureCollection", )" + crs + R"("features": [)";
    for (std::size_t i = 0; i < points.size(); ++i)
      text += std::string(i == 0 ? "" : ", ") + R"({"type": "Feature", "properties": {)" +
              points[i].second + R"(}, "geometry": {"type": "Point", "coordinates": [)" +
              points[i].first + "]}}";
    return folder_.write("trees.geojson", text + "]}");
  }
  TreePoints read(const std::string& path, const TreePointRules& rules = {},
                  const std::string& crs = utm_33, double unit_m = 1) const {
    return read_tree_points(path, rules, crs, unit_m);
  }
  std::string refusal(const std::string& path, const TreePointRules& rules = {},
                      const std::string& crs = utm_33) const {
    return refusal_of([&] { read(path, rules, crs); });
  }
  static bool says(const TreePoints& read, const std::string& what) {
    for (const auto& note : read.notes)
      if (note.find(what) != note.npos) return true;
    return false;
  }

  WorkFolder folder_;
};

// 15 E, 50 N lies on the zone's central meridian: 500 000 m east; the arc of the meridian times
// 0.9996 (Snyder 1987, Map Projections, eqs. 3-21 and 8-10) is 5 538 630.7 m.
TEST_F(TreePointFile, StandOnTheMapOfTheSceneWithTheirOwnSizes) {
  const auto [trees, notes] =
      read(geojson({{"15, 50", R"("height": 12, "crown_diameter": 7, "id": 4)"},
                    {"15, 50", R"("height": "40 ft", "crown_diameter": "7,5")"}}));
  ASSERT_EQ(trees.size(), 2u);
  EXPECT_NEAR(trees[0].place.u, 500'000, 0.01);
  EXPECT_NEAR(trees[0].place.v, 5'538'630.7, 0.1);
  EXPECT_EQ(trees[0].height_m, 12);
  EXPECT_EQ(trees[0].crown_m, 7);
  EXPECT_EQ(trees[0].name, "4");
  EXPECT_NEAR(trees[1].height_m, 40 * 0.3048, 1e-12);
  EXPECT_EQ(trees[1].crown_m, 7.5);
}

TEST_F(TreePointFile, MetresOfTheSceneStayAsTheyAre) {
  const std::string crs =
      R"("crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::32633"}}, )";
  const std::string own = geojson({{"500010, 5538600", R"("height": 9, "crown_m": 4)"}}, crs);
  EXPECT_EQ(read(own).trees.front().place.u, 500'010);
  EXPECT_NE(refusal(own, {}, "EPSG:25832").find("the scene has EPSG:25832"), std::string::npos);
  // Without a CRS degrees by the standard, which these cannot be.
  EXPECT_EQ(
      read(geojson({{"500010, 5538600", R"("height": 9, "crown_m": 4)"}})).trees.front().place.v,
      5'538'600);
}

TEST_F(TreePointFile, OfOpenStreetMapTreesAlone) {
  const TreePoints found =
      read(geojson({{"15, 50", R"("natural": "tree", "height": "8 m", "diameter_crown": 5)"},
                    {"15, 50", R"("natural": "peak", "height": 900)"},
                    {"15, 50", R"("highway": "bus_stop")"}}));
  EXPECT_EQ(found.trees.size(), 1u);
  EXPECT_TRUE(says(found, "2 points that are no trees by their column natural are left out"));
}

TEST_F(TreePointFile, SizesThatAreNotWrittenAreRefusedOrGiven) {
  const std::string path = geojson({{"15, 50", R"("height": 8, "crown_m": 5, "id": "a")"},
                                    {"15, 50", R"("height": null, "crown_m": 5, "id": "b")"},
                                    {"15, 50", R"("height": 6, "crown_m": "wide", "id": "c")"}});
  const std::string told = refusal(path);
  EXPECT_NE(told.find("1 trees have no height above 0 (b)"), told.npos) << told;
  EXPECT_NE(told.find("1 trees have no width of crown above 0 (c: 'wide')"), told.npos) << told;
  EXPECT_NE(told.find("default_crown_m"), told.npos) << told;
  const TreePoints found = read(path, {.default_height_m = 7, .default_crown_m = 3});
  EXPECT_EQ(found.trees[1].height_m, 7);
  EXPECT_EQ(found.trees[2].crown_m, 3);
  EXPECT_TRUE(says(found, "1 trees without height have 7 m"));
  EXPECT_TRUE(says(found, "such as 'wide'"));
}

TEST_F(TreePointFile, ColumnsAreNamedWhereTheyAreNotKnown) {
  const std::string path = geojson({{"15, 50", R"("H_TOT": 8, "KROON": 5, "height": 1)"}});
  const std::string told = refusal(path);
  EXPECT_NE(told.find("no column of widths of crowns is known"), told.npos) << told;
  EXPECT_NE(told.find("H_TOT, KROON, height"), told.npos) << told;
  const TreePoints found = read(path, {.height = "H_TOT", .crown = "KROON"});
  EXPECT_EQ(found.trees.front().height_m, 8);
  EXPECT_NE(refusal(path, {.height = "nowhere"}).find("has no column 'nowhere'"),
            std::string::npos);
}

TEST_F(TreePointFile, WhatCannotBeIsRefused) {
  const std::string in_centimetres =
      geojson({{"15, 50", R"("height": 800, "crown_m": 5, "id": "b")"}});
  EXPECT_NE(refusal(in_centimetres).find("b has 800 m in column height"), std::string::npos);
  EXPECT_EQ(read(geojson({{"15, 50", R"("height": 800, "crown_m": 500)"}}), {}, utm_33, 0.01)
                .trees.front()
                .height_m,
            8);
  EXPECT_NE(refusal(geojson({{"15, 50", R"("height": 8, "crown_m": 5)"}}), {}, "")
                .find("the scene has no CRS"),
            std::string::npos);
  EXPECT_NE(
      refusal(folder_.write("no.geojson", "{\"type\": \"FeatureCollection\", \"features\": ["))
          .find("no.geojson"),
      std::string::npos);
  EXPECT_NE(
      refusal(folder_.write(
                  "area.geojson",
                  R"({"type": "Polygon", "coordinates": [[[15,50],[15.1,50],[15,50.1],[15,50]]]})"))
          .find("area.geojson"),
      std::string::npos);
}

}  // namespace
}  // namespace sunload::test
