// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What CityGML files are refused for, and the place that is told.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "io/base/file_text.h"
#include "tests/io/scene/citygml/gml_text.h"
#include "tests/support/paths.h"

namespace sunload {
namespace {

using namespace sunload::test;

std::string with_surface(const std::string& geometry) {
  return city_gml(building("b", "\n" + element("bldg:lod2MultiSurface", geometry)));
}

std::string with_ring(const std::string& positions, const std::string& attributes = {}) {
  return with_surface(multi_surface({element(
      "gml:Polygon",
      element("gml:exterior",
              element("gml:LinearRing", "\n" + element("gml:posList", positions, attributes))))}));
}

TEST(SceneCityGmlRefusals, OtherXml) {
  EXPECT_NE(refusal("a.xml", "<kml xmlns='http://www.opengis.net/kml/2.2'/>").find("it is KML"),
            std::string::npos);
  EXPECT_NE(refusal("a.gml", "<?xml version='1.0'?>\n\n<gbXML/>").find("a.gml:3:1: is no CityGML"),
            std::string::npos);
  EXPECT_NE(
      refusal("a.gml", "<ogr:FeatureCollection xmlns:ogr='http://x'/>").find("GML of another"),
      std::string::npos);
  EXPECT_NE(refusal("a.gml", "<towns/>").find("its first element is 'towns', not CityModel"),
            std::string::npos);
  EXPECT_NE(refusal("a.gml", "plain text").find("is no XML"), std::string::npos);
  EXPECT_NE(refusal("a.gml", "<CityModel><a>\n</b></CityModel>").find("a.gml:2:"),
            std::string::npos);
  EXPECT_NE(refusal("a.gml", city_gml("").substr(0, 200)).find("is the file complete?"),
            std::string::npos);
}

TEST(SceneCityGmlRefusals, Positions) {
  EXPECT_NE(refusal("n.gml", with_ring("0 0 0 1 0 zero 0 1 0"))
                .find("n.gml:5:1: posList: 'zero' is no number"),
            std::string::npos);
  EXPECT_NE(refusal("n.gml", with_ring("0 0 0 1 NaN 0 0 1 0")).find("'NaN' is no number"),
            std::string::npos);
  EXPECT_NE(refusal("n.gml", with_ring("0 0 0 1 0 1e999 0 1 0")).find("'1e999'"),
            std::string::npos);
  EXPECT_NE(refusal("n.gml", with_ring("0 0 0 1 0 0 0 1")).find("posList has 8 numbers"),
            std::string::npos);
  EXPECT_NE(refusal("n.gml", with_ring("0 0 1 0 0 1", "srsDimension=\"2\"")).find("footprints"),
            std::string::npos);
  EXPECT_NE(refusal("n.gml", with_ring("0 0 0 1e12 0 0 0 1 0")).find("beyond all coordinates"),
            std::string::npos);
  EXPECT_NE(refusal("n.gml", with_ring("0 0 0 &bomb; 0 0 0 1 0")).find("'&bomb;' is no number"),
            std::string::npos);
}

TEST(SceneCityGmlRefusals, PlanDataOfALevelThatIsNotRead) {
  const auto flat = element(
      "gml:Polygon",
      element("gml:exterior",
              element("gml:LinearRing", element("gml:posList", "35 139 35 140 36 139 35 139",
                                                "srsDimension=\"2\""))));
  const auto text = city_gml(
      building("b",
               element("bldg:lod0FootPrint", multi_surface({flat})) +
                   element("bldg:lod1MultiSurface",
                           multi_surface({polygon("35.6 139.7 0 35.7 139.7 0 35.6 139.8 0")}))),
      envelope("EPSG:6697"));
  EXPECT_EQ(read_text("plan.gml", text).polygon_count(), 1u);
  EXPECT_NE(refusal("plan.gml", text, {0, 1, "0"}).find("srsDimension"), std::string::npos);
}

TEST(SceneCityGmlRefusals, ThinFacesAreLeftOut) {
  const auto model = read_text("thin.gml", with_ring("0 0 0 1 0 0 0 0 0"));
  EXPECT_EQ(model.polygon_count(), 0u);
  EXPECT_TRUE(has_note(model, "1 surfaces of fewer than 3 vertices"));
  EXPECT_TRUE(model.object_names.empty());
}

TEST(SceneCityGmlRefusals, ImplicitGeometries) {
  const auto of = [](const std::string& matrix, const std::string& point) {
    return city_gml(member(element(
        "veg:SolitaryVegetationObject",
        element("veg:lod1ImplicitRepresentation",
                element("core:ImplicitGeometry", element("core:transformationMatrix", matrix) +
                                                     element("core:relativeGMLGeometry",
                                                             multi_surface({polygon(triangle)})) +
                                                     point)))));
  };
  const auto at = element("core:referencePoint", element("gml:Point", element("gml:pos", "1 2 3")));
  EXPECT_NE(refusal("i.gml", of("1 0 0", at)).find("has 3 numbers"), std::string::npos);
  EXPECT_NE(refusal("i.gml", of("1 0 0 0 0 1 0 0 0 0 1 0 5 5 5 1", at)).find("last row"),
            std::string::npos);
  EXPECT_NE(refusal("i.gml", of("1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1", "")).find("no referencePoint"),
            std::string::npos);
}

TEST(SceneCityGmlRefusals, LinksInCirclesEnd) {
  const auto circle = read_text(
      "circle.gml",
      with_surface(element(
          "gml:MultiSurface",
          link("gml:surfaceMember", "a") +
              element("gml:surfaceMember",
                      element("gml:CompositeSurface",
                              link("gml:surfaceMember", "a") + surface_members({polygon(triangle)}),
                              "gml:id=\"a\"")) +
              link("gml:surfaceMember", "nowhere") +
              "<gml:surfaceMember xlink:href=\"other.gml#b\"/>")));
  EXPECT_EQ(circle.polygon_count(), 1u);
  EXPECT_TRUE(has_note(circle, "1 links to what is not in the file"));
  EXPECT_TRUE(has_note(circle, "1 links to other files"));
  const auto curve = with_surface(multi_surface({element(
      "gml:Polygon",
      element("gml:exterior",
              element("gml:Ring", link("gml:curveMember", "r") + link("gml:curveMember", "r"),
                      "gml:id=\"r\"")))}));
  EXPECT_NE(refusal("curve.gml", curve), "");
  std::string deep = polygon(triangle);
  for (int k = 0; k < 100; ++k)
    deep = element("gml:CompositeSurface", element("gml:surfaceMember", deep));
  EXPECT_NE(refusal("deep.gml", with_surface(deep)).find("nest too deep"), std::string::npos);
}

/// Ten references to ten references …: each names the one before ten times.
TEST(SceneCityGmlRefusals, BombsOfLinksAreSmall) {
  std::string levels =
      element("gml:CompositeSurface", surface_members({polygon(triangle)}), "gml:id=\"l0\"");
  for (int k = 1; k < 12; ++k) {
    std::string ten;
    for (int i = 0; i < 10; ++i) ten += link("gml:surfaceMember", "l" + std::to_string(k - 1));
    levels += element("gml:CompositeSurface", ten, "gml:id=\"l" + std::to_string(k) + "\"");
  }
  const auto model = read_text(
      "bomb.gml", with_surface(element("gml:MultiSurface", link("gml:surfaceMember", "l11"))) + "");
  EXPECT_EQ(model.polygon_count(), 0u);
  const auto all = city_gml(
      building("b", element("bldg:lod2MultiSurface",
                            element("gml:MultiSurface", element("gml:surfaceMembers", levels)))));
  EXPECT_EQ(read_text("bomb.gml", all).polygon_count(), 1u);
}

TEST(SceneCityGml, PackedAndInOtherEncodings) {
  const auto text = city_gml(building("b", element("bldg:lod1Solid", box_solid(0, 0, 0, 1, 1, 1))));
  std::string latin =
      city_gml(building("Stra\xDF"
                        "e",
                        element("bldg:lod1Solid", box_solid(0, 0, 0, 1, 1, 1))));
  latin.replace(latin.find("UTF-8"), 5, "ISO-8859-1");
  EXPECT_EQ(read_text("latin.gml", latin).object_names, std::vector<std::string>{"Straße"});
  EXPECT_EQ(read_text("bom.xml", "\xEF\xBB\xBF" + text).polygon_count(), 6u);
  EXPECT_EQ(read_text("town.citygml", text).polygon_count(), 6u);
  const auto path = write_text("packed.gml", text);
  ASSERT_EQ(std::system(("gzip -k -f '" + path + "'").c_str()), 0);
  EXPECT_EQ(read_scene_file(path + ".gz", {}).polygon_count(), 6u);
}

/// The town that comes with the program, written as CityGML, is the same model.
TEST(SceneCityGml, IsTheSameTownAsInCityJson) {
  const auto town =
      read_scene_file(source_folder() + std::string("/configs/models/town.city.json"), {});
  const auto model =
      read_text("town.gml", city_gml_of(town, "http://www.opengis.net/def/crs/EPSG/0/25833"));
  EXPECT_EQ(model.object_names, town.object_names);
  EXPECT_EQ(model.object_kinds, town.object_kinds);
  EXPECT_EQ(model.crs, "EPSG:25833");
  ASSERT_EQ(model.polygon_count(), town.polygon_count());
  for (std::size_t p = 0; p < town.polygon_count(); ++p) {
    EXPECT_EQ(model.facts[p].surface, town.facts[p].surface);
    EXPECT_EQ(model.facts[p].object, town.facts[p].object);
    ASSERT_EQ(ring_size(model, p, 0), ring_size(town, p, 0));
    for (std::int64_t k = 0; k < ring_size(town, p, 0); ++k)
      EXPECT_EQ(corner(model, p, 0, k), corner(town, p, 0, k));
  }
}

}  // namespace
}  // namespace sunload
