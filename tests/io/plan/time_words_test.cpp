// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What `check` and `info` say of time and north, and the warnings about clocks and places.
#include "io/plan/time_words.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "geo/base/check.h"
#include "io/plan/scene_build.h"
#include "tests/support/refusal_of.h"
#include "tests/support/scene_text.h"

namespace sunload {
namespace {

using test::write_text;

const std::string plzen = "latitude_deg: 49.7475, longitude_deg: 13.3776";

Study study_of(const std::string& site, const std::string& period,
               const std::string& scene = "builtin: {name: box_on_plane}") {
  const std::string text = "format: sunload-study-1\nname: words\nsite: {" + site + "}\nperiod: {" +
                           period + "}\nscene: {" + scene + "}\n";
  return read_study(write_text("words.yaml", text)).variants.front();
}

struct Words {
  LightSeries light;
  std::vector<std::string> warnings;
  std::string text;
};

Words words_of(const Study& study) {
  const BuiltScene built = build_scene(study);
  const LightSeries light = light_series(study, built.site);
  return {light, built.warnings, time_words(light, built.site, study, built.site_source)};
}

std::string clocks(const std::string& zone, const std::string& days) {
  const Study study = study_of(plzen + ", timezone: " + zone, "days: [" + days + "]");
  return clock_words(words_of(study).light, TimeZone(zone));
}

bool says(const std::vector<std::string>& lines, const std::string& part) {
  for (const auto& line : lines)
    if (line.find(part) != line.npos) return true;
  return false;
}

bool says(const std::string& text, const std::string& part) {
  return says(std::vector{text}, part);
}

TEST(NorthWords, TakeTheShortWayRound) {
  EXPECT_TRUE(says(north_words(358.153), "1.847 deg counter-clockwise"));
  EXPECT_TRUE(says(north_words(-30), "30.000 deg counter-clockwise"));
  EXPECT_TRUE(says(north_words(30), "30.000 deg clockwise"));
  EXPECT_EQ(north_words(360), north_words(0));
}

// Rules of 2026 of the European Union, Lord Howe (half an hour) and Chile (at midnight).
TEST(ClockWords, NameTheDaysOfOtherLength) {
  EXPECT_EQ(clocks("Europe/Prague", "2026-03-28, 2026-03-29, 2026-03-30"),
            "forward by 60 min at 2026-03-29 03:00 +02:00 (23 hours that day)");
  EXPECT_EQ(clocks("Europe/Prague", "2026-10-25"),
            "back by 60 min at 2026-10-25 02:00 +01:00 (25 hours that day)");
  EXPECT_EQ(clocks("Australia/Lord_Howe", "2026-04-05"),
            "back by 30 min at 2026-04-05 01:30 +10:30 (24.5 hours that day)");
  EXPECT_EQ(clocks("America/Santiago", "2026-09-05"), "");
  EXPECT_EQ(clocks("America/Santiago", "2026-09-06"),
            "forward by 60 min at 2026-09-06 01:00 -03:00 (23 hours that day)");
  EXPECT_EQ(clocks("Europe/Prague", "2026-03-28, 2026-10-26"), "");
  EXPECT_EQ(clocks("+01:00", "2026-03-29"), "");
}

TEST(PoleWords, WaitForASunThatStandsHigh) {
  const std::string svalbard = "latitude_deg: 78.22, longitude_deg: 15.65, timezone: UTC";
  const std::string dark = words_of(study_of(svalbard, "days: [2026-12-21]")).text;
  EXPECT_TRUE(says(dark, "below the horizon on all days")) << dark;
  const std::string later =
      words_of(study_of(svalbard, "days: [2026-01-10, 2026-02-20, 2026-04-01]")).text;
  EXPECT_TRUE(says(later, "at 2026-04-01 ")) << later;
  const std::string low = words_of(study_of(svalbard, "days: [2026-01-10, 2026-02-20]")).text;
  EXPECT_TRUE(says(low, "at 2026-02-20 ")) << low;
}

// Noon of the june solstice in Plzen: 90 - 49.7475 + 23.44 degrees high, 2 min before 12:08 + 1 h.
TEST(PoleWords, AreTheShadowOfNoon) {
  const std::string text =
      words_of(study_of(plzen + ", timezone: Europe/Prague", "days: [2026-06-21]")).text;
  EXPECT_TRUE(says(text, "casts 0.494 m of shadow towards 0.0 deg")) << text;
  EXPECT_NEAR(1 / std::tan(radians(90 - 49.7475 + 23.44)), 0.494, 0.0005);
  EXPECT_TRUE(says(text, "at 2026-06-21 13:08")) << text;
  EXPECT_TRUE(says(text, "deg north, 13.37760 deg east"));
}

// Table of the U.S. Naval Observatory, as in reference/01_solar_position/rise_transit_set.csv.
TEST(TimeWords, SayWhenTheSunRisesAndSets) {
  const auto text = [](const std::string& place, const std::string& day) {
    return words_of(study_of(place, "days: [" + day + "]")).text;
  };
  const std::string summer =
      text("latitude_deg: 39, longitude_deg: -105, timezone: \"-07:00\"", "2015-08-02");
  EXPECT_TRUE(says(summer, "day        2015-08-02: sunrise 05:01, sunset 19:10")) << summer;
  EXPECT_TRUE(says(summer, "civil twilight: dawn 04:3")) << summer;
  const std::string svalbard = "latitude_deg: 78.22, longitude_deg: 15.65, timezone: UTC";
  EXPECT_TRUE(says(text(svalbard, "2026-12-21"), "no sunrise")) << text(svalbard, "2026-12-21");
  EXPECT_TRUE(says(text(svalbard, "2026-06-21"), "no sunset"));
}

TEST(TimeWords, SayWhatHillsHide) {
  write_text("hills.csv", "azimuth_deg,elevation_deg\n0,80\n180,80\n");
  const std::string text =
      words_of(study_of(plzen + ", timezone: UTC, horizon: hills.csv", "days: [2026-06-21]")).text;
  EXPECT_TRUE(says(text, "hills      2 points, up to 80.00 deg high")) << text;
  EXPECT_TRUE(says(text, "17 of 17 intervals with the sun up lie wholly behind them")) << text;
  EXPECT_TRUE(says(text, "if hills did not hide the sun then")) << text;
}

TEST(Clocks, TimesThatAreSkippedOrRepeatedAreNamed) {
  const auto notes = [](const std::string& instant) {
    return words_of(
               study_of(plzen + ", timezone: Europe/Prague", "instants: [\"" + instant + "\"]"))
        .light.notes;
  };
  EXPECT_TRUE(says(notes("2024-03-31T02:30"), "2024-03-31 02:30 is skipped in Europe/Prague"));
  EXPECT_TRUE(says(notes("2024-10-27T02:30"), "2024-10-27 02:30 occurs twice in Europe/Prague"));
  EXPECT_TRUE(notes("2024-10-27T02:30+01:00").empty());
}

TEST(Clocks, OfAnotherLongitudeAreWarnedAbout) {
  const auto warned = [](const std::string& place, const std::string& zone) {
    return says(words_of(study_of(place + ", timezone: " + zone, "days: [2024-06-21]")).light.notes,
                "are site.timezone and longitude right");
  };
  EXPECT_TRUE(warned(plzen, "America/New_York"));
  EXPECT_TRUE(warned("latitude_deg: 41.98, longitude_deg: 87.92", "America/Chicago"));
  EXPECT_FALSE(warned("latitude_deg: 41.98, longitude_deg: -87.92", "America/Chicago"));
  EXPECT_FALSE(warned("latitude_deg: 39.47, longitude_deg: 75.99", "Asia/Shanghai"));  // Kashgar
  EXPECT_FALSE(warned("latitude_deg: 1.87, longitude_deg: -157.4", "Pacific/Kiritimati"));
  EXPECT_FALSE(warned("latitude_deg: -33.4, longitude_deg: -70.7", "UTC"));
}

// A box of 10 m at the origin of a map or in the middle of its country.
Words on_map(const std::string& site, double x, double y) {
  std::string obj;
  for (const double dx : {0.0, 10.0})
    for (const double dy : {0.0, 10.0})
      obj += "v " + std::to_string(x + dx) + " " + std::to_string(y + dy) + " 0\n";
  write_text("plate.obj", obj + "f 1 3 4 2\n");
  return words_of(study_of(site + ", timezone: UTC", "days: [2024-06-21]", "files: [plate.obj]"));
}

TEST(SiteOnMap, WarnsOfAMapThatIsNotTheScenes) {
  const std::string netherlands = "crs: \"EPSG:28992\"";
  EXPECT_FALSE(says(on_map(netherlands, 85000, 447000).warnings, "area of use"));
  EXPECT_TRUE(says(on_map(netherlands, 2683000, 1247000).warnings, "area of use"));
  EXPECT_TRUE(says(on_map(netherlands + ", " + plzen, 85000, 447000).warnings,
                   "the sun is that of the study's position"));
  EXPECT_FALSE(
      says(on_map(netherlands + ", latitude_deg: 52.0113, longitude_deg: 4.3679", 85000, 447000)
               .warnings,
           "the sun is that of the study's position"));
}

// Heights are in metres, and shadows would be too short by what lengths are too long.
TEST(SiteOnMap, MapsThatKeepNoLengthsAreRefusedOrWarnedOf) {
  const auto refusal = [](const std::string& site, double x, double y) {
    return test::refusal_of([&] { on_map(site, x, y); });
  };
  // Berlin in web Mercator, whether or not the study gives the place.
  for (const char* more : {"", ", latitude_deg: 52.5, longitude_deg: 13.4"}) {
    const std::string text = refusal("crs: \"EPSG:3857\"" + std::string(more), 1491700, 6891000);
    EXPECT_TRUE(says({text}, "64 % longer than on the ground there")) << text;
    EXPECT_TRUE(says({text}, "EPSG:32633")) << text;
  }
  // At the equator it is a sphere's map of an ellipsoid: 0.7 % off.
  EXPECT_TRUE(says(on_map("crs: \"EPSG:3857\"", -8738000, -20000).warnings, "lengths on the map"));
  // Cyprus on the map of all of Europe.
  EXPECT_TRUE(says(on_map("crs: \"EPSG:3035\"", 6430000, 1660000).warnings, "lengths on the map"));
  EXPECT_FALSE(says(on_map("crs: \"EPSG:28992\"", 85000, 447000).warnings, "lengths"));
  EXPECT_FALSE(says(on_map("crs: \"EPSG:25833\"", 391000, 5820000).warnings, "lengths"));
}

TEST(SiteOnMap, FeetThatAreTakenForMetresAreWarnedOf) {
  const auto warnings = [](const std::string& unit, double scale) {
    write_text("plate.obj",
               fmt::format("v {0} {1} 0\nv {2} {1} 0\nv {2} {3} 0\nf 1 2 3\n", 990000 * scale,
                           200000 * scale, 990030 * scale, 200030 * scale));
    return words_of(study_of("crs: \"EPSG:2263\", timezone: UTC", "days: [2024-06-21]",
                             "files: [plate.obj]" + unit))
        .warnings;
  };
  EXPECT_TRUE(says(warnings("", 1), "scene.unit_m: 0.3048006096 makes metres of them"));
  EXPECT_FALSE(says(warnings(", unit_m: 0.3048006096", 1), "unit_m"));
  EXPECT_FALSE(says(warnings(", unit_m: 0.3048006096", 1), "area of use"));
}

TEST(SiteOnMap, AMapThatCannotBeReadIsNotSaidToGiveNorth) {
  const Words words = on_map("crs: \"EPSG:999999\", " + plzen, 0, 0);
  EXPECT_TRUE(says(words.warnings, "north and elevation are not taken from it"));
  EXPECT_FALSE(says(words.text, "north from")) << words.text;
}

TEST(SiteOnMap, MapsThatShearAreWarnedOf) {
  // Athens: walls that are square on the ground make angles of 91 degrees on it.
  EXPECT_TRUE(says(on_map("crs: \"EPSG:3035\"", 5520000, 1740000).warnings, "lengths on the map"));
}

/// Site of a house of GeoJSON that names no system.
Site site_of_plan(const std::string& ring, const std::string& crs) {
  write_text("plan.geojson",
             R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": )"
             R"({"height": 9}, "geometry": {"type": "Polygon", "coordinates": [[)" +
                 ring + "]]}}]}");
  return build_scene(study_of(crs + "timezone: Europe/Berlin", "days: [2024-06-21]",
                              "files: [plan.geojson]"))
      .site;
}

TEST(SiteOnMap, DegreesGoOntoTheMapOfTheStudy) {
  // Passau lies in the zone beside the one that Bavaria uses.
  for (const char* crs : {"", "crs: \"EPSG:25832\", ", "crs: \"EPSG:25833+7837\", "}) {
    const Site site =
        site_of_plan("[13.46, 48.57], [13.461, 48.57], [13.461, 48.571], [13.46, 48.57]", crs);
    EXPECT_NEAR(site.latitude_deg, 48.5705, 1e-4) << crs;
    EXPECT_NEAR(site.longitude_deg, 13.4605, 1e-4) << crs;
  }
}

TEST(SiteOnMap, NumbersThatAreNoDegreesAreMetresOfTheStudysMap) {
  const auto site = [](const std::string& crs) {
    return site_of_plan(
        "[391000, 5820000], [391009, 5820000], [391009, 5820009], [391000, 5820000]", crs);
  };
  EXPECT_NEAR(site("crs: \"EPSG:25833\", ").latitude_deg, 52.52, 0.01);
  EXPECT_TRUE(says(test::refusal_of([&] { site(""); }), "metres of a map, site.crs names it"));
}

}  // namespace
}  // namespace sunload
