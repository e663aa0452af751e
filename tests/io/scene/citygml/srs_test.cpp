// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Coordinate systems of CityGML files: names, order of axes, degrees.
#include <gtest/gtest.h>

#include <cmath>

#include "geo/sun/site.h"
#include "io/scene/citygml/srs_name.h"
#include "tests/io/scene/citygml/gml_text.h"

namespace sunload {
namespace {

using namespace sunload::test;

TEST(SrsNames, InEveryForm) {
  const auto read = [](const std::string& name) {
    const auto srs = read_srs_name(name);
    return srs.crs + (srs.has_official_axes ? " as defined" : "");
  };
  EXPECT_EQ(read("urn:ogc:def:crs:EPSG::2393"), "urn:ogc:def:crs:EPSG::2393 as defined");
  EXPECT_EQ(read("http://www.opengis.net/def/crs/EPSG/0/6697"),
            "http://www.opengis.net/def/crs/EPSG/0/6697 as defined");
  EXPECT_EQ(read("EPSG:25832"), "EPSG:25832");
  EXPECT_EQ(read("epsg:25832, epsg:5783"), "EPSG:25832");
  EXPECT_EQ(read("http://www.opengis.net/gml/srs/epsg.xml#31467"), "EPSG:31467");
  EXPECT_EQ(read("urn:adv:crs:ETRS89_UTM32*DE_DHHN2016_NH"), "EPSG:25832");
  EXPECT_EQ(read("urn:adv:crs:DE_DHDN_3GK3"), "EPSG:31467");
  EXPECT_EQ(read("urn:adv:crs:DE_1890_JHO"), "urn:adv:crs:DE_1890_JHO");
  EXPECT_EQ(read("my town"), "my town");
}

/// A box whose first corner is (x, y), with x first in the file, or y.
std::string town(const std::string& srs, double x, double y, bool y_first, double size = 10) {
  std::vector<std::string> polygons;
  for (const auto& face : box_faces(x, y, 30, size, size, 10)) {
    std::string positions;
    std::istringstream words(face);
    for (std::string a, b, c; words >> a >> b >> c;)
      positions += (y_first ? b + " " + a : a + " " + b) + " " + c + " ";
    polygons.push_back(polygon(positions));
  }
  return city_gml(building("b", element("bldg:lod1Solid", solid(polygons))), envelope(srs));
}

Vec3 first_corner(const PolygonModel& model) { return model.vertices.at(0); }

TEST(SceneCityGmlSrs, TheAreaOfUseTellsTheOrderOfAxes) {
  // Gauss–Krüger, whose definition begins in the north: files mostly do not.
  for (const bool y_first : {false, true})
    for (const char* srs :
         {"EPSG:31467", "urn:ogc:def:crs:EPSG::31467", "urn:adv:crs:DE_DHDN_3GK3*DE_DHHN92_NH"}) {
      const auto model = read_text("gk.gml", town(srs, 3512345, 5412345, y_first));
      EXPECT_EQ(first_corner(model), (Vec3{3512345, 5412345, 30})) << srs;
      EXPECT_EQ(model.crs, "EPSG:31467");
      EXPECT_TRUE(
          has_note(model, y_first ? "taken as northing, easting" : "taken as easting, northing"));
      EXPECT_TRUE(has_note(model, "outside of its area of use"));
    }
}

TEST(SceneCityGmlSrs, NorthFirstInASystemThatBeginsInTheEastIsReadSoWhereItsAreaSaysSo) {
  for (const bool y_first : {false, true}) {
    const auto model = read_text("utm.gml", town("EPSG:25832", 512345, 5412345, y_first));
    EXPECT_EQ(first_corner(model), (Vec3{512345, 5412345, 30}));
    EXPECT_EQ(has_note(model, "taken as northing, easting"), y_first);
  }
  // Where neither fits, the file's order stays; a warning tells of the place.
  const auto lost = read_text("lost.gml", town("EPSG:25832", 1, 2, false));
  EXPECT_EQ(first_corner(lost), (Vec3{1, 2, 30}));
}

TEST(SceneCityGmlSrs, RoofsTellTheOrderOfAxesWhereBothFit) {
  // Soldner Berlin: eastings and northings are alike.
  for (const bool y_first : {false, true})
    for (const char* srs : {"EPSG:3068", "urn:ogc:def:crs,crs:EPSG:6.12:3068,crs:EPSG:6.12:5783"}) {
      const auto model = read_text("berlin.gml", town(srs, 24000, 21000, y_first));
      EXPECT_EQ(first_corner(model), (Vec3{24000, 21000, 30})) << srs << y_first;
      EXPECT_TRUE(has_note(model, "roofs would face down"));
    }
}

TEST(SceneCityGmlSrs, TheFormOfTheNameDecidesWhereNothingElseDoes) {
  const auto wall = [](const std::string& srs) {
    const std::string upright = "24000 21000 0 24010 21000 0 24010 21000 9 24000 21000 0";
    return read_text(
        "wall.gml",
        city_gml(building("b", element("bldg:lod1MultiSurface", multi_surface({polygon(upright)}))),
                 envelope(srs)));
  };
  EXPECT_EQ(first_corner(wall("EPSG:3068")), (Vec3{24000, 21000, 0}));
  EXPECT_EQ(first_corner(wall("urn:ogc:def:crs:EPSG::3068")), (Vec3{21000, 24000, 0}));
}

TEST(SceneCityGmlSrs, DegreesArePutOnAMap) {
  // The middle of Tokyo, latitude first as the Japanese survey writes it, and longitude first.
  for (const bool y_first : {true, false}) {
    const auto model = read_text("tokyo.gml", town("http://www.opengis.net/def/crs/EPSG/0/6697",
                                                   139.76, 35.68, y_first, 0.001));
    EXPECT_EQ(model.crs, "EPSG:32654");
    EXPECT_TRUE(has_note(model, "degrees of the model are projected to EPSG:32654"));
    EXPECT_TRUE(
        has_note(model, y_first ? "taken as latitude, longitude" : "taken as longitude, latitude"));
    const Site site = site_from_crs(model.crs, first_corner(model));
    EXPECT_NEAR(site.latitude_deg, 35.68, 1e-6);
    EXPECT_NEAR(site.longitude_deg, 139.76, 1e-6);
    const auto box = bounding_box(model.vertices);
    EXPECT_NEAR(box.high.x - box.low.x, 111320 * std::cos(35.68 * pi / 180) * 0.001, 2.5);
    EXPECT_NEAR(box.high.y - box.low.y, 110.95, 2.5);  // grid north is not quite north
    EXPECT_EQ(box.low.z, 30);
    EXPECT_EQ(box.high.z, 40);
  }
  const auto south = read_text("sydney.gml", town("EPSG:4326", 151.2, -33.87, false, 0.001));
  EXPECT_EQ(south.crs, "EPSG:32756");
}

TEST(SceneCityGmlSrs, SystemsThatPlaceNothing) {
  EXPECT_EQ(read_text("own.gml", town("#local", 0, 0, false)).crs, "");
  EXPECT_EQ(read_text("unknown.gml", town("urn:my:town", 1, 2, false)).crs, "urn:my:town");
  EXPECT_NE(refusal("earth.gml", town("EPSG:4978", 1, 2, false)).find("geocentric"),
            std::string::npos);
  EXPECT_NE(
      refusal("far.gml", town("EPSG:4326", 500000, 5400000, false)).find("beyond all coordinates"),
      std::string::npos);
}

TEST(SceneCityGmlSrs, FeetAreMadeMetresByTheStudysUnit) {
  const auto text = town("EPSG:2263", 990000, 200000, false);
  const auto in_feet = read_text("york.gml", text, {0, 0.3048006096});
  EXPECT_TRUE(in_feet.notes.empty());
  EXPECT_NEAR(site_from_crs(in_feet.crs, first_corner(in_feet)).latitude_deg, 40.71, 0.02);
}

TEST(SceneCityGmlSrs, TheNameMayStandAtAGeometry) {
  const auto text = city_gml(
      building("b", element("bldg:lod1MultiSurface",
                            element("gml:MultiSurface", surface_members({polygon(triangle)}),
                                    "srsName=\"EPSG:28992\" srsDimension=\"3\""))));
  EXPECT_EQ(read_text("late.gml", text).crs, "EPSG:28992");
}

}  // namespace
}  // namespace sunload
