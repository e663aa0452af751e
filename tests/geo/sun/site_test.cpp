// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/sun/site.h"

#include <gtest/gtest.h>

#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/UTMUPS.hpp>
#include <cmath>
#include <string>

#include "geo/base/check.h"

namespace sunload {
namespace {

constexpr double rounding = 1e-12;

void expect_same(Vec3 a, Vec3 b, double tolerance) { EXPECT_LE(norm(a - b), tolerance); }

TEST(Site, AxesAtKnownPlaces) {
  // Greenwich meridian, equator: up is x, east is y, north is z.
  const auto at_origin = enu_from_ecef({});
  expect_same(at_origin({1, 0, 0}), {0, 0, 1}, 0);
  expect_same(at_origin({0, 1, 0}), {1, 0, 0}, 0);
  expect_same(at_origin({0, 0, 1}), {0, 1, 0}, 0);
  // North pole: up is z.
  expect_same(enu_from_ecef({.latitude_deg = 90, .longitude_deg = 10})({0, 0, 1}), {0, 0, 1}, 0);
  constexpr double semi_major_axis_m = 6378137;  // WGS84
  expect_same(ecef_position({.elevation_m = 100}), {semi_major_axis_m + 100, 0, 0}, 1e-9);
}

TEST(Site, NorthTurnsTheScene) {
  // +y of the scene points east: what stands in the east is ahead, what stands north is left.
  const auto turned = scene_from_enu({.north_deg = 90});
  expect_same(turned({1, 0, 0}), {0, 1, 0}, 0);
  expect_same(turned({0, 1, 0}), {-1, 0, 0}, 0);
  // A direction at azimuth a appears at azimuth a - north_deg in the scene.
  const auto scene = scene_from_enu({.north_deg = 35});
  const auto place = horizontal(scene(enu_direction({120, 20})));
  EXPECT_NEAR(place.azimuth_deg, 85, 1e-10);
  EXPECT_NEAR(place.elevation_deg, 20, 1e-10);
}

TEST(Site, RotationsAreRotations) {
  for (double latitude : {-90.0, -33.9, 0.0, 52.0, 90.0}) {
    const Site site{.latitude_deg = latitude, .longitude_deg = 100 + latitude, .north_deg = 17};
    for (const auto& r : {enu_from_ecef(site), scene_from_enu(site)}) {
      expect_same(cross(r.rows[0], r.rows[1]), r.rows[2], rounding);
      EXPECT_NEAR(norm(r.rows[0]), 1, rounding);
      EXPECT_NEAR(norm(r.rows[1]), 1, rounding);
    }
  }
}

TEST(Site, RefusesNonsense) {
  EXPECT_THROW(ecef_position({.latitude_deg = 91}), std::logic_error);
  EXPECT_THROW(scene_from_enu({.north_deg = NAN}), std::logic_error);
}

void expect_place(const std::string& text, double latitude_deg, double longitude_deg,
                  double tolerance_deg = 1e-9) {
  const Site site = site_from_text(text);
  EXPECT_NEAR(site.latitude_deg, latitude_deg, tolerance_deg) << text;
  EXPECT_NEAR(site.longitude_deg, longitude_deg, tolerance_deg) << text;
}

TEST(SiteFromText, ReadsDegrees) {
  const double latitude_deg = 49 + 44.0 / 60 + 51.0 / 3600;
  const double longitude_deg = 13 + 22.0 / 60 + 39.0 / 3600;
  for (const char* text :
       {"49d44'51\"N 13d22'39\"E", "N49:44:51 E13:22:39", "49:44:51 13:22:39",
        "13d22'39\"E 49d44'51\"N", "49°44′51″N 13°22′39″E", "49d44.85N, 13d22.65E"}) {
    expect_place(text, latitude_deg, longitude_deg);
  }
  expect_place("33d55'31\"S 18d25'26\"W", -33.925277777778, -18.423888888889);
  expect_place("49.7475 13.3776", 49.7475, 13.3776);
}

// Coordinates and MGRS square of one point, from the manual of GeographicLib's GeoConvert.
TEST(SiteFromText, ReadsUtmUpsAndMgrs) {
  constexpr double half_metre_deg = 1e-5;
  for (const char* text :
       {"38n 444140.54 3684706.36", "38north 444140.54 3684706.36", "38SMB4414084706"}) {
    expect_place(text, 33.3, 44.4, half_metre_deg);
  }
  // With its band. The inverse is the library's own, checked there.
  double northing_m = 0, easting_m = 0;
  int zone = 0;
  bool is_north = false;
  GeographicLib::UTMUPS::Forward(49.7475, 13.3776, zone, is_north, easting_m, northing_m);
  const std::string rest = " " + std::to_string(easting_m) + " " + std::to_string(northing_m);
  expect_place("33U" + rest, 49.7475, 13.3776, half_metre_deg);
  expect_place("33u" + rest, 49.7475, 13.3776, half_metre_deg);
  expect_place("33 n" + rest, 49.7475, 13.3776, half_metre_deg);
  GeographicLib::UTMUPS::Forward(-33.9, 18.4, zone, is_north, easting_m, northing_m);
  expect_place("34H " + std::to_string(easting_m) + " " + std::to_string(northing_m), -33.9, 18.4,
               half_metre_deg);
  EXPECT_EQ(site_from_text("north 2000000 2000000").latitude_deg, 90);
}

TEST(SiteFromText, RefusesTheRest) {
  const auto expect_refused = [](const std::string& text, const std::string& part) {
    try {
      site_from_text(text);
      ADD_FAILURE() << text << " was read";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  expect_refused("", "no position on Earth");
  expect_refused("Prague", "no position on Earth");
  expect_refused("49d44'51\"N", "no position on Earth");
  expect_refused("91N 10E", "no position on Earth");
  expect_refused("49d61'N 13E", "no position on Earth");
  expect_refused("38S 444140 3684706", "write the zone as 38south or 38north");
  expect_refused("33O 383000 5512000", "UTM has no band O");
  expect_refused("33C 383000 5512000", "not in the band C");
  expect_refused("33U", "at least two digits");
  expect_refused("33UUR", "at least two digits");
  expect_refused("33UUR81", "at least two digits");
  expect_refused("nan nan", "no position on Earth");
}

TEST(SiteFromText, PositionsReadBack) {
  const Site site{.latitude_deg = -33.925, .longitude_deg = 18.42};
  EXPECT_EQ(position_text(site), "33d55'30.0\"S 018d25'12.0\"E");
  expect_place(position_text(site), site.latitude_deg, site.longitude_deg);
}

TEST(Site, DutchGrid) {
  // Amersfoort: Schreutelkamp & Strang van Hees (2001), Benaderingsformules, WGS84 of the origin;
  // the seven-parameter shift (no grid file) is within a metre of it.
  constexpr double metre_deg = 1.0 / 67000;  // of longitude there
  const auto origin = site_from_crs("EPSG:28992", {155000, 463000, 3});
  EXPECT_NEAR(origin.latitude_deg, 52.15517440, metre_deg);
  EXPECT_NEAR(origin.longitude_deg, 5.38720621, metre_deg);
  EXPECT_EQ(origin.elevation_m, 3);
  // The projection's own meridian: only the datum's small rotation is left.
  EXPECT_NEAR(std::remainder(origin.north_deg, 360), 0, 1e-3);
}

TEST(Site, EveryWayToNameASystem) {
  const auto named = site_from_crs("EPSG:28992", {85000, 447000, 0});
  for (const auto* name :
       {"28992", "EPSG:7415", "7415", "urn:ogc:def:crs:EPSG::7415", "urn:ogc:def:crs:EPSG::28992",
        "urn:ogc:def:crs,crs:EPSG::28992,crs:EPSG::5709",
        "https://www.opengis.net/def/crs/EPSG/0/7415",
        "http://www.opengis.net/def/crs/EPSG/0/28992"}) {
    SCOPED_TRACE(name);
    const auto site = site_from_crs(name, {85000, 447000, 0});
    EXPECT_EQ(site.latitude_deg, named.latitude_deg);
    EXPECT_EQ(site.longitude_deg, named.longitude_deg);
    EXPECT_EQ(site.north_deg, named.north_deg);
  }
  // Soldner Berlin, whose own axes are north, east: 25 km east and 20 km north is Alexanderplatz.
  const auto berlin =
      site_from_crs("http://www.opengis.net/def/crs/EPSG/6.12/3068", {25500, 21200, 0});
  EXPECT_NEAR(berlin.latitude_deg, 52.52, 0.01);
  EXPECT_NEAR(berlin.longitude_deg, 13.41, 0.02);
  EXPECT_LT(std::abs(std::remainder(berlin.north_deg, 360)), 1);
}

TEST(Site, GridNorthIsTheMeridianConvergence) {
  // GeographicLib's UTM gives the convergence in closed form. Central differences over 100 m:
  // the third-order term is (50 m / 6.4e6 m)² of the convergence, far below the rounding of a
  // nanometre in 100 m.
  constexpr double tolerance_deg = 1e-7;
  for (double northing : {100000.0, 5.5e6, 9.2e6}) {
    const auto site = site_from_crs("EPSG:32633", {300000, northing, 0});
    double latitude = 0, longitude = 0, convergence_deg = 0, scale = 0;
    GeographicLib::UTMUPS::Reverse(33, true, 300000, northing, latitude, longitude, convergence_deg,
                                   scale);
    EXPECT_NEAR(site.latitude_deg, latitude, 1e-10);
    EXPECT_NEAR(site.longitude_deg, longitude, 1e-10);
    EXPECT_NEAR(std::remainder(site.north_deg - convergence_deg, 360), 0, tolerance_deg);
  }
}

TEST(Site, GridNorthLeadsToTheNeighbour) {
  struct Case {
    const char* crs;
    Vec3 position;
  };
  // Conic, polar, oblique, metres and feet, and a system with south and west first.
  for (const auto& [crs, position] :
       {Case{"EPSG:5514", {-743000, -1043000, 0}}, Case{"EPSG:3031", {500000, -900000, 0}},
        Case{"EPSG:2056", {2683000, 1247000, 0}}, Case{"EPSG:2263", {300000, 60000, 0}},
        Case{"EPSG:2154", {652000, 6862000, 0}}, Case{"EPSG:2053", {100000, 2900000, 0}}}) {
    SCOPED_TRACE(crs);
    const auto here = site_from_crs(crs, position);
    const auto there = site_from_crs(crs, position + Vec3{0, 1000, 0});
    double distance_m = 0, azimuth_deg = 0, back_deg = 0;
    GeographicLib::Geodesic::WGS84().Inverse(here.latitude_deg, here.longitude_deg,
                                             there.latitude_deg, there.longitude_deg, distance_m,
                                             azimuth_deg, back_deg);
    EXPECT_NEAR(distance_m, 1000,
                30);  // the polar map is true at 71° south, 2.8 % short at the pole
    // Over 1 km a grid line turns against the geodesic by some 1 km / Earth's radius at most.
    EXPECT_NEAR(std::remainder(azimuth_deg - here.north_deg, 360), 0, degrees(1000 / 6.4e6));
  }
  // Prague lies west of Krovak's meridian (24°50′): grid north points to the east of north there.
  const auto prague = site_from_crs("EPSG:5514", {-743000, -1043000, 0});
  EXPECT_NEAR(prague.latitude_deg, 50.09, 0.02);
  EXPECT_NEAR(prague.longitude_deg, 14.42, 0.05);
}

TEST(Site, RefusesWhatIsNoMap) {
  for (const auto* crs : {"EPSG:4326", "EPSG:4979", "EPSG:4978", "EPSG:5709", "EPSG:999999",
                          "nonsense", "", "EPSG:9518"}) {
    EXPECT_THROW(site_from_crs(crs, {0, 0, 0}), InputError) << crs;
  }
  EXPECT_THROW(site_from_crs("EPSG:5513", {1043000, 743000, 0}), InputError);  // left-handed
  EXPECT_THROW(site_from_crs("EPSG:32633", {1e12, 1e12, 0}), InputError);
  EXPECT_THROW(site_from_crs("EPSG:32633", {NAN, 0, 0}), InputError);
}

TEST(Site, WarnsOutsideOfTheAreaOfUse) {
  EXPECT_EQ(area_of_use_warning("EPSG:7415", {85000, 447000, 0}), "");
  EXPECT_NE(area_of_use_warning("EPSG:28992", {2683000, 1247000, 0}), "");
  // New Zealand Transverse Mercator's area crosses the date line.
  EXPECT_EQ(area_of_use_warning("EPSG:2193", {1749000, 5428000, 0}), "");
}

TEST(Site, MapsAreStretchedWhereTheyShear) {
  EXPECT_NEAR(map_stretch("EPSG:25833", {500000, 5500000, 0}), -0.0004, 1e-6);  // by definition
  // Athens on the equal-area map of Europe: as much longer one way as shorter across, and neither
  // is an axis. Against lengths on the ground in every direction.
  const Vec3 athens{5520000, 1740000, 0};
  double longest = -1;
  const Site middle = site_from_crs("EPSG:3035", athens);
  for (double angle = 0; angle < 180; ++angle) {
    const Vec3 step{100 * std::cos(radians(angle)), 100 * std::sin(radians(angle)), 0};
    const double ground = distance_m(middle, site_from_crs("EPSG:3035", athens + step));
    longest = std::max(longest, 100 / ground - 1);
  }
  // The ground's way is a sphere's here: within its flattening.
  EXPECT_NEAR(map_stretch("EPSG:3035", athens), longest, 1.0 / 298);
  EXPECT_GT(longest, 0.008);
}

}  // namespace
}  // namespace sunload
