// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Hours of sun on a day against reference 06 and closed forms; the Czech rule's own figures.
#include "io/measure/sun_day.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "geo/base/units.h"
#include "io/measure/rules.h"
#include "tests/support/reference.h"
#include "tests/support/scenes.h"

namespace sunload::test {
namespace {

constexpr double second_h = 1 / 3600.0;
// Each end of a span is found to half a second, and rays start a float's rounding off a surface: of
// the scenes below 1 mm, seen from 7 m and more, 0.01° of the sun's 15° an hour.
constexpr double found_within_h = 4 * second_h;

const std::vector<MeasuredInterval> no_intervals;

/// Rule `word` on one point.
struct OnePoint {
  Scene scene;
  Site site;
  MeasuredPoint point;

  MeasureValues of(MeasureParameters parameters) const {
    const RayCaster caster(scene.mesh);
    const MeasuredScene measured{{point},          1,          caster,      site,
                                 Refraction::none, Ut1::table, no_intervals};
    const MeasureRule* rule = find_measure_rule(parameters.rule);
    for (const RuleKey& key : rule->keys)
      parameters.numbers.try_emplace(key.key, key.absent.value_or(0));
    for (const RuleWords& key : rule->words)
      parameters.words.try_emplace(key.key, key.words.front());
    return rule->start(parameters, measured)->values();
  }
};

CivilTime date_of(const std::string& text) { return parse_time(text).civil; }

constexpr double far_m = 500;  // from where walls that go on for ever may be cut

void add_walls(SceneBuilder& builder, const nlohmann::json& at) {
  const std::string kind = at.at("kind");
  const auto& of = at.at("parameters");
  const int wall = builder.material({"wall", 0.3, 0, 0});
  const auto box = [&](Vec3 low, Vec3 high) {
    builder.box(low, high, wall, SceneBuilder::Facing::outward);
  };
  const double height = of.at("H"), thick = 1;
  if (kind == "south_wall_at_distance") {
    const double d = of.at("distance");
    return box({-far_m, -d - thick, 0}, {far_m, -d, height});
  }
  const double half_width = number(of.at("W")) / 2;
  const bool is_court = kind == "courtyard_centre";
  const double half_depth = is_court ? number(of.at("D")) / 2 : far_m;
  if (kind != "ew_street_centre")
    for (const double side : {-half_width - thick, half_width})
      box({side, -half_depth, 0}, {side + thick, half_depth, height});
  if (kind == "ns_street_centre") return;
  const double across = is_court ? half_depth : half_width;
  const double along = is_court ? half_width + thick : far_m;
  for (const double side : {-across - thick, across})
    box({-along, side, 0}, {along, side + thick, height});
}

TEST(SunDay, HoursAndInstantsOfTheReference) {
  for (const auto& at : reference_cases("06_direct_sun/sun_hours.json")) {
    SceneBuilder builder;
    add_walls(builder, at);
    const int offset_h = static_cast<int>(std::round(-at.at("window_start_utc_h").get<double>()));
    Site site;
    site.latitude_deg = at.at("lat_deg");
    site.longitude_deg = at.at("lon_deg_east");
    site.timezone = fmt::format("{}{:02}:00", offset_h < 0 ? "-" : "+", std::abs(offset_h));
    const OnePoint point{builder.scene(), site, {{0, 0, 0}, {0, 0, 1}}};
    MeasureParameters of;
    of.rule = "sun_hours";
    of.date = date_of(at.at("date"));
    const MeasureValues found = point.of(of);
    const double truth = at.at("sun_hours");
    const auto& spans = at.at("intervals_utc_h");
    EXPECT_NEAR(found.value[0], truth,
                found_within_h * static_cast<double>(std::max<std::size_t>(1, spans.size())))
        << at.at("id");
    if (spans.size() != 1) continue;
    const UnixTime midnight = utc_from_calendar(*of.date);
    EXPECT_NEAR((longest(found.spans[0]).begin - midnight) / 3600, spans[0][0].get<double>(),
                found_within_h);
    EXPECT_NEAR((longest(found.spans[0]).end - midnight) / 3600, spans[0][1].get<double>(),
                found_within_h);
    // Planted fault: a wall of a hundredth more.
    auto higher = at;
    higher["parameters"]["H"] = 1.01 * number(at.at("parameters").at("H"));
    SceneBuilder other;
    add_walls(other, higher);
    const OnePoint shaded{other.scene(), site, point.point};
    EXPECT_GT(std::abs(shaded.of(of).value[0] - truth), 2 * found_within_h) << at.at("id");
  }
}

Site prague_meridian() {
  Site site;
  site.latitude_deg = 50;
  site.longitude_deg = 15;
  site.timezone = "+01:00";
  return site;
}

/// Nothing but a far small wall, so that there is something to cast rays at.
Scene open_land() {
  SceneBuilder builder;
  builder.box({1000, 1000, 0}, {1001, 1001, 0.01}, builder.material({"wall", 0.3, 0, 0}),
              SceneBuilder::Facing::outward);
  return builder.scene();
}

// ČSN 73 0581 (shading diagram of 1 March, 50° N): the sun counts from 7:10 to 16:50 true solar
// time, 580 minutes; the diagram is divided by ten minutes.
TEST(CzechRule, CountsTheMinutesOfItsDiagram) {
  const OnePoint point{open_land(), prague_meridian(), {{0, 0, 0}, {0, 0, 1}}};
  MeasureParameters of;
  of.rule = "csn_73_4301";
  of.date = CivilTime{2026, 3, 1};
  constexpr double division_min = 10;
  EXPECT_NEAR(60 * point.of(of).value[0], 580, division_min / 2);
}

/// Azimuth of the sun at the ends of the longest span.
std::array<double, 2> azimuths(const MeasureValues& found, const Site& site) {
  const SunEphemeris sun(longest(found.spans[0]).begin, longest(found.spans[0]).end, site,
                         Refraction::none, Ut1::table, standard_air(0));
  return {sun(longest(found.spans[0]).begin).azimuth_deg,
          sun(longest(found.spans[0]).end).azimuth_deg};
}

// The sun's azimuth changes by 0.3° a minute at the most here.
constexpr double azimuth_within_deg = 0.01;

TEST(CzechRule, LeavesOutTheSunAlongTheWindow) {
  const Site site = prague_meridian();
  const OnePoint south{open_land(), site, {{0, 0, 5}, {0, -1, 0}}};
  const OnePoint east{open_land(), site, {{0, 0, 5}, {1, 0, 0}}};
  MeasureParameters of;
  of.rule = "csn_73_4301";
  of.date = CivilTime{2026, 3, 1};
  const auto of_south = azimuths(south.of(of), site);
  EXPECT_NEAR(of_south[0], 90 + 25, azimuth_within_deg);
  EXPECT_NEAR(of_south[1], 270 - 25, azimuth_within_deg);
  EXPECT_NEAR(azimuths(east.of(of), site)[1], 180 - 25, azimuth_within_deg);
  // Planted fault: another angle.
  of.numbers["least_plan_angle_deg"] = 24;
  EXPECT_GT(std::abs(azimuths(east.of(of), site)[1] - 155), 10 * azimuth_within_deg);
}

TEST(SunDay, AngleToTheSurfaceIsThatOfTheSunsRay) {
  const Site site = prague_meridian();
  const OnePoint roof{open_land(), site, {{0, 0, 5}, {0, 0, 1}}};
  MeasureParameters by_elevation, by_angle;
  by_elevation.rule = by_angle.rule = "sun_hours";
  by_elevation.date = by_angle.date = CivilTime{2026, 6, 21};
  by_elevation.numbers["least_elevation_deg"] = 30;
  by_angle.numbers["least_angle_deg"] = 30;
  EXPECT_NEAR(roof.of(by_elevation).value[0], roof.of(by_angle).value[0], found_within_h);
  EXPECT_LT(roof.of(by_angle).value[0], 12);
}

/// A mast of 2 m before a wall in the south.
OnePoint behind_a_mast() {
  SceneBuilder builder;
  builder.box({-1, -20, 0}, {1, -19, 60}, builder.material({"mast", 0.3, 0, 0}),
              SceneBuilder::Facing::outward);
  return {builder.scene(), prague_meridian(), {{0, 0, 5}, {0, -1, 0}}};
}

TEST(SunDay, SpansThatAreTooShortDoNotCount) {
  const OnePoint point = behind_a_mast();
  MeasureParameters all, longest_alone, long_ones;
  for (auto* of : {&all, &longest_alone, &long_ones}) {
    of->rule = "sun_hours";
    of->date = CivilTime{2026, 3, 1};
  }
  longest_alone.words["count"] = "longest";
  const double whole = point.of(all).value[0], one = point.of(longest_alone).value[0];
  EXPECT_NEAR(2 * one, whole, 0.5);  // noon divides the day but for the equation of time
  long_ones.numbers["least_span_min"] = 60 * one - 0.01;
  EXPECT_NEAR(point.of(long_ones).value[0], one, 0.2 * one);
  long_ones.numbers["least_span_min"] = 60 * one + 1;
  EXPECT_EQ(point.of(long_ones).value[0], 0);
}

TEST(SunDay, NightAndHillsLeaveNone) {
  OnePoint point{open_land(), prague_meridian(), {{0, 0, 5}, {0, -1, 0}}};
  MeasureParameters of;
  of.rule = "en_17037";
  of.date = CivilTime{2026, 3, 21};
  of.numbers["least_elevation_deg"] = 13;
  EXPECT_GT(point.of(of).value[0], 4);
  point.site.horizon = Horizon({{0, 80}});
  EXPECT_EQ(point.of(of).value[0], 0);
  EXPECT_TRUE(point.of(of).spans[0].empty());
  point.site.horizon = {};
  point.site.latitude_deg = 89;
  EXPECT_EQ(point.of(of).value[0], 0) << "the sun stays below 13°";
}

TEST(SunDay, ADayIsAsLongAsItsClocksSay) {
  Site site = prague_meridian();
  site.timezone = "Europe/Oslo";
  site.latitude_deg = 89;  // polar day from the equinox on
  const Scene scene = open_land();
  const RayCaster caster(scene.mesh);
  const MeasuredScene measured{{}, 0, caster, site, Refraction::none, Ut1::table, no_intervals};
  const auto hours = [&](const CivilTime& date) {
    return sun_course(measured, date, 0).counted.at(0).length_s() / 3600;
  };
  EXPECT_EQ(hours({2026, 6, 1}), 24);
  EXPECT_EQ(hours({2026, 3, 29}), 23) << "clocks go forward";
}

}  // namespace
}  // namespace sunload::test
