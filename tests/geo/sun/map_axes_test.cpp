// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/sun/map_axes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geo/base/check.h"
#include "geo/sun/site.h"

namespace sunload {
namespace {

TEST(MapAxes, AreThoseOfTheDefinition) {
  const auto words = [](const std::string& crs) {
    const MapAxes axes(crs);
    return axes.name() + (axes.is_known() ? "" : " unknown") +
           (axes.is_geocentric() ? " geocentric" : "") + (axes.is_in_degrees() ? " degrees" : "") +
           (axes.is_north_first() ? " north first" : "");
  };
  EXPECT_EQ(words("25832"), "EPSG:25832");
  EXPECT_EQ(words("urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::5783"), "EPSG:25832");
  EXPECT_EQ(words("EPSG:31467"), "EPSG:31467 north first");
  EXPECT_EQ(words("EPSG:5513"), "EPSG:5513 north first");  // southing, westing
  EXPECT_EQ(words("EPSG:5514"), "EPSG:5514");
  EXPECT_EQ(words("http://www.opengis.net/def/crs/EPSG/0/6697"), "EPSG:6668 degrees north first");
  EXPECT_EQ(words("OGC:CRS84"), "OGC:CRS84 degrees");
  EXPECT_EQ(words("EPSG:4978"), "EPSG:4978 geocentric");
  EXPECT_EQ(words("no such thing"), "no such thing unknown");
}

TEST(MapAxes, KnowWhereTheSystemIsUsed) {
  const MapAxes gauss_krueger("EPSG:31467");
  EXPECT_TRUE(gauss_krueger.is_in_use_at(3512345, 5412345));
  EXPECT_FALSE(gauss_krueger.is_in_use_at(5412345, 3512345));
  const MapAxes japan("EPSG:6668");
  EXPECT_TRUE(japan.is_in_use_at(139.7, 35.7));
  EXPECT_FALSE(japan.is_in_use_at(35.7, 139.7));
  EXPECT_FALSE(japan.is_in_use_at(1e9, NAN));
}

TEST(MapAxes, TellTheirUnit) {
  EXPECT_NEAR(MapAxes("EPSG:2263").unit_m(), 1200.0 / 3937, 1e-12);
  EXPECT_EQ(MapAxes("EPSG:25832").unit_m(), 1);
  EXPECT_EQ(MapAxes("EPSG:4326").unit_m(), 1);
}

TEST(MapAxes, UtmZones) {
  EXPECT_EQ(utm_at(35.7, 139.7), "EPSG:32654");
  EXPECT_EQ(utm_at(-33.9, 151.2), "EPSG:32756");
  EXPECT_EQ(utm_at(0, -180), "EPSG:32601");
  EXPECT_EQ(utm_at(0, 179.999), "EPSG:32660");
  EXPECT_EQ(utm_at(0, 180), "EPSG:32601");
}

TEST(MapFromDegrees, IsTheWayBackFromTheMap) {
  const MapFromDegrees map("EPSG:4326", "EPSG:32633");
  const Vec3 there = map(13.4, 52.5, 34);
  const Vec3 expected = map_position("EPSG:32633", 52.5, 13.4, 34);
  EXPECT_NEAR(there.x, expected.x, 1e-6);
  EXPECT_NEAR(there.y, expected.y, 1e-6);
  EXPECT_EQ(there.z, 34);
  EXPECT_FALSE(std::isfinite(map(13.4, 500, 0).x));
  EXPECT_THROW(MapFromDegrees("no such thing", "EPSG:32633"), InputError);
  EXPECT_THROW(MapFromDegrees("EPSG:4326", "EPSG:2263"), InputError);  // in feet
  EXPECT_THROW(MapFromDegrees("EPSG:4326", "EPSG:4258"), InputError);
}

TEST(MapAxes, OneMapIsThatWithAndWithoutHeights) {
  EXPECT_TRUE(are_of_one_map("EPSG:25833", "EPSG:25833+7837"));
  EXPECT_TRUE(are_of_one_map("nonsense", "nonsense"));
  EXPECT_FALSE(are_of_one_map("EPSG:25833", "EPSG:25832+7837"));
}

}  // namespace
}  // namespace sunload
