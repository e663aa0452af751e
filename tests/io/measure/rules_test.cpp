// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Rules of intervals and series on cases by hand; the page of all rules.
#include "io/measure/rules.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "geo/base/units.h"
#include "io/measure/bright_intervals.h"
#include "tests/support/paths.h"
#include "tests/support/scenes.h"

namespace sunload::test {
namespace {

/// A point that looks south and one that looks up, before a wall in the west.
class TwoPoints {
 public:
  TwoPoints() {
    SceneBuilder builder;
    builder.box({-11, -50, 0}, {-10, 50, 50}, builder.material({"wall", 0.3, 0, 0}),
                SceneBuilder::Facing::outward);
    scene_ = builder.scene();
    caster_ = std::make_unique<RayCaster>(scene_.mesh);
    site.timezone = "UTC";
  }
  void add(const CivilTime& begin, double hours, double dni, Vec3 sun, double dhi = 0) {
    const UnixTime t = utc_from_calendar(begin);
    intervals_.push_back({t, t + 3600 * hours, dni, dhi, {{normalized(sun), 3600 * hours}}});
  }
  MeasuredScene scene() const {
    return {{{{0, 0, 1}, {0, -1, 0}}, {{0, 0, 1}, {0, 0, 1}}},
            2,
            *caster_,
            site,
            Refraction::none,
            Ut1::table,
            intervals_};
  }
  Site site{};

 private:
  Scene scene_;
  std::unique_ptr<RayCaster> caster_;
  std::vector<MeasuredInterval> intervals_;
};

constexpr Vec3 south{0, -1, 1}, north{0, 1, 1}, west{-1, -0.1, 1};

TEST(BrightSun, CountsWhatIsSeenOfAStrongBeam) {
  TwoPoints points;
  points.add({2026, 1, 1, 10}, 1, 500, south);
  points.add({2026, 1, 1, 11}, 2, 119, south);
  points.add({2026, 6, 1, 5}, 3, 120, north);
  points.add({2026, 6, 1, 18}, 4, 800, west);  // behind the wall
  const MeasuredScene scene = points.scene();
  MeasureParameters of;
  of.numbers = {{"least_dni_w_m2", 120}, {"least_h", 0}};
  const auto found = find_measure_rule("bright_sun")->start(of, scene)->values();
  EXPECT_DOUBLE_EQ(found.value[0], 1);
  EXPECT_DOUBLE_EQ(found.value[1], 4);
  // BRE 209: of 8 hours of sunshine; in winter 1.
  of.words = {{"season", "year"}};
  const auto year = find_measure_rule("bre_209_probable_sun")->start(of, scene)->values();
  EXPECT_DOUBLE_EQ(year.value[0], 100.0 / 8);
  EXPECT_DOUBLE_EQ(year.value[1], 400.0 / 8);
  of.words = {{"season", "winter"}};
  const auto winter = find_measure_rule("bre_209_probable_sun")->start(of, scene)->values();
  EXPECT_DOUBLE_EQ(winter.value[1], 100.0 / 8);
}

TEST(BrightSun, WinterLastsFromEquinoxToEquinox) {
  TwoPoints points;
  points.add({2026, 3, 20, 10}, 1, 500, south);
  points.add({2026, 3, 21, 10}, 1, 500, south);
  points.add({2026, 3, 22, 10}, 1, 500, south);
  points.add({2026, 9, 20, 10}, 1, 500, south);
  points.add({2026, 9, 21, 10}, 1, 500, south);
  points.add({2026, 9, 22, 10}, 1, 500, south);
  // Both equinoxes are of both halves of the year.
  EXPECT_EQ(bright_stretches(points.scene(), sunshine_w_m2, InSeason::winter).size(), 4u);
  points.site.latitude_deg = -33.9;
  EXPECT_EQ(bright_stretches(points.scene(), sunshine_w_m2, InSeason::winter).size(), 4u);
  EXPECT_EQ(bright_stretches(points.scene(), sunshine_w_m2).size(), 6u);
}

TEST(BrightSun, WinterIsTheSitesOwn) {
  TwoPoints points;
  points.add({2026, 3, 21, 21}, 1, 500, south);  // the morning of 22 March in Sydney
  points.add({2026, 6, 21, 2}, 1, 500, south);
  points.site.timezone = "Australia/Sydney";
  const auto winter = [&] {
    return bright_stretches(points.scene(), sunshine_w_m2, InSeason::winter).size();
  };
  points.site.latitude_deg = 33.9;
  EXPECT_EQ(winter(), 0u) << "by the clock of the site the equinox is over";
  points.site.latitude_deg = -33.9;
  EXPECT_EQ(winter(), 2u);
}

TEST(LightHours, CountsIntervalsAboveAThreshold) {
  TwoPoints points;
  points.add({2026, 1, 1, 10}, 1, 0, south);
  points.add({2026, 1, 1, 11}, 2, 0, south);
  points.add({2026, 1, 1, 13}, 4, 0, south);
  const MeasuredScene scene = points.scene();
  MeasureParameters of;
  of.numbers = {{"above_w_m2", 100}, {"above_lx", 0}, {"least_h", 0}};
  of.words = {{"light", "mirror"}};
  const std::vector<double> none, last{200, 100}, first{101, 0, 99, 300};
  // Batches in any order, of any size.
  const auto measure = find_measure_rule("light_hours")->start(of, scene);
  EXPECT_EQ(measure->series(), "irradiance_mirror");
  measure->watch({2, 1, last, none});
  measure->watch({0, 2, first, none});
  const auto found = measure->values();
  EXPECT_DOUBLE_EQ(found.value[0], 1 + 4);
  EXPECT_DOUBLE_EQ(found.value[1], 2);
}

TEST(DaylightFactor, IsOfIntervalsWithoutSun) {
  TwoPoints points;
  points.add({2026, 1, 1, 10}, 1, 0, south, 200);
  points.add({2026, 1, 1, 11}, 2, 0, south, 100);
  points.add({2026, 1, 1, 13}, 4, 50, south, 300);  // the sun shines: it does not count
  const MeasuredScene scene = points.scene();
  MeasureParameters of;
  of.numbers = {{"least_percent", 0}};
  of.words = {{"light", "total"}};
  const auto measure = find_measure_rule("daylight_factor")->start(of, scene);
  const std::vector<double> none, all{100, 20, 40, 10, 300, 300};
  measure->watch({0, 3, all, none});
  const auto found = measure->values();
  EXPECT_DOUBLE_EQ(found.value[0], 100 * (100 + 2 * 40.0) / (200 + 2 * 100.0));
  EXPECT_DOUBLE_EQ(found.value[1], 100 * (20 + 2 * 10.0) / 400);
  TwoPoints sunny;
  sunny.add({2026, 1, 1, 13}, 4, 50, south, 300);
  const MeasuredScene bright = sunny.scene();
  const auto never = find_measure_rule("daylight_factor")->start(of, bright);
  EXPECT_TRUE(std::isnan(never->values().value[0]));
}

TEST(PeakLight, TellsTheFirstIntervalOfTheLargest) {
  TwoPoints points;
  points.add({2026, 1, 1, 10}, 1, 0, south);
  points.add({2026, 1, 1, 11}, 2, 0, south);
  points.add({2026, 1, 1, 13}, 4, 0, south);
  const MeasuredScene scene = points.scene();
  MeasureParameters of;
  of.words = {{"light", "total"}};
  const std::vector<double> none, last{200, 0}, first{100, 0, 200, 0};
  for (const bool is_reversed : {false, true}) {
    const auto measure = find_measure_rule("peak_light")->start(of, scene);
    EXPECT_EQ(measure->series(), "irradiance");
    if (is_reversed) measure->watch({2, 1, last, none});
    measure->watch({0, 2, first, none});
    if (!is_reversed) measure->watch({2, 1, last, none});
    const auto found = measure->values();
    EXPECT_EQ(found.value[0], 200);
    ASSERT_EQ(found.spans[0].size(), 1u);
    EXPECT_EQ(found.spans[0][0].begin, utc_from_calendar({2026, 1, 1, 11}));
    EXPECT_EQ(found.spans[0][0].length_s(), 2 * 3600);
    EXPECT_TRUE(found.spans[1].empty());
  }
}

TEST(RoofPotential, IsTheSumOfTheSeries) {
  TwoPoints points;
  points.add({2026, 1, 1, 10}, 1, 0, south);
  points.add({2026, 1, 1, 11}, 2, 0, south);
  const MeasuredScene scene = points.scene();
  const auto measure = find_measure_rule("roof_potential")->start({}, scene);
  const std::vector<double> none, all{500, 100, 250, 0};
  measure->watch({0, 2, all, none});
  const auto found = measure->values();
  EXPECT_DOUBLE_EQ(found.value[0], (500 + 2 * 250) / 1000.0);
  EXPECT_DOUBLE_EQ(found.value[1], 0.1);
}

TEST(Rules, HaveLevelsSourcesAndKnownKeys) {
  for (const MeasureRule& rule : measure_rules()) {
    MeasureParameters of;
    for (const RuleKey& key : rule.keys) {
      of.numbers[key.key] = key.absent.value_or(1);
      const auto& known = measure_keys();
      EXPECT_TRUE(std::any_of(known.begin(), known.end(), [&](const MeasureKey& k) {
        return k.key == key.key;
      })) << key.key;
    }
    for (const RuleWords& key : rule.words) of.words[key.key] = key.words.front();
    const auto levels = levels_of(rule, of);
    for (std::size_t l = 1; l < levels.size(); ++l)
      EXPECT_GT(levels[l].value, levels[l - 1].value) << rule.word;
    EXPECT_FALSE(rule.source.empty() || rule.definition.empty() || rule.units.empty());
    EXPECT_TRUE(rule.start != nullptr);
    EXPECT_EQ(rule.needs == MeasureRule::Needs::sun_path, rule.day.has_value()) << rule.word;
  }
}

/// With what a study writes, else the rule's own.
MeasureParameters parameters_of(const MeasureRule& rule) {
  MeasureParameters of;
  for (const RuleKey& key : rule.keys) of.numbers[key.key] = key.absent.value_or(13);
  for (const RuleWords& key : rule.words) of.words[key.key] = key.words.front();
  of.numbers["area_percent"] = usual_area_percent;
  if (rule.day) of.date = CivilTime{2026, rule.day->first, rule.day->second};
  return of;
}

TEST(Rules, DefinitionsTellTheLimitsThatTheStudyChanges) {
  for (const MeasureRule& rule : measure_rules()) {
    const bool has_defaults = std::all_of(rule.keys.begin(), rule.keys.end(),
                                          [](const RuleKey& key) { return key.absent; });
    if (has_defaults) {
      EXPECT_EQ(definition_of(rule, parameters_of(rule)), rule.definition);
    }
  }
  const auto& garden = *find_measure_rule("bre_209_garden");
  MeasureParameters of = parameters_of(garden);
  of.numbers["least_h"] = 3;
  of.numbers["area_percent"] = 60;
  of.date = CivilTime{2026, 4, 21};
  EXPECT_EQ(definition_of(garden, of),
            garden.definition + "; here with least_h 3, area_percent 60, date 2026-04-21");
  // The standard tabulates it: a limit of the study, whatever it is.
  const auto& exposure = *find_measure_rule("en_17037");
  EXPECT_EQ(definition_of(exposure, parameters_of(exposure)),
            exposure.definition + "; here with least_elevation_deg 13");
  const auto& probable = *find_measure_rule("bre_209_probable_sun");
  of = parameters_of(probable);
  of.words["season"] = "winter";
  EXPECT_EQ(definition_of(probable, of), probable.definition + "; here with season winter");
}

TEST(Rules, AreOnThePageOfMeasures) {
  std::ifstream file(source_folder() + "/docs/measures.md");
  std::ostringstream page;
  page << file.rdbuf();
  EXPECT_NE(page.str().find(measure_rules_markdown()), std::string::npos)
      << "docs/measures.md must have this table:\n"
      << measure_rules_markdown();
}

}  // namespace
}  // namespace sunload::test
