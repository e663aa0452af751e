// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/joined_intervals.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "geo/base/units.h"
#include "geo/time/period_parts.h"
#include "geo/time/time.h"
#include "io/plan/interval_lights.h"
#include "io/plan/series_steps.h"
#include "tests/support/study_plan.h"

namespace sunload::test {
namespace {

constexpr double rounding = 1e-9;

VariantPlan plan_with(const std::string& solver, const std::string& output,
                      const std::string& period = "start: 2026-06-01, end: 2026-06-04, step_min: 1",
                      const std::string& light = "source: clear_sky") {
  return plan_of(
      "format: sunload-study-1\nname: t\n"
      "site: {latitude_deg: 50, longitude_deg: 14, timezone: Europe/Prague}\n"
      "period: {" +
      period + "}\nlight: {" + light + "}\nscene: {builtin: {name: street}}\nsolver: {" + solver +
      "}\noutput: {" + output + "}\n");
}

TEST(JoinedIntervals, AreThoseOfAnHourOfTheClock) {
  const VariantPlan plan = plan_with("", "series_step: day");
  ASSERT_EQ(plan.light.intervals.size(), 72u);
  for (const LitInterval& hour : plan.light.intervals) {
    EXPECT_EQ(hour.parts().size(), 60u);
    EXPECT_NEAR(hour.when.length_s(), seconds_per_hour, rounding);
  }
  EXPECT_EQ(plan.steps.size(), 3u);
  EXPECT_NE(plan.light.notes.back().find("4320 intervals are solved as 72"), std::string::npos);
}

TEST(SeriesSteps, OfOneIntervalEachAreTheIntervals) {
  const std::string hours = "start: 2026-06-01, end: 2026-06-04, step_min: 60";
  const VariantPlan of_hours = plan_with("", "series_step: 60 min", hours);
  EXPECT_TRUE(of_hours.steps.empty());
  EXPECT_TRUE(of_hours.study.output.series_step.is_interval());
  EXPECT_EQ(of_hours.content_hash, plan_with("", "", hours).content_hash);
  // Of minutes that are solved together, too.
  EXPECT_TRUE(plan_with("", "series_step: 60 min").steps.empty());
  EXPECT_EQ(plan_with("", "series_step: 120 min", hours).steps.size(), 36u);
}

TEST(JoinedIntervals, AreOfStepsThatAreShorterThanAnHour) {
  EXPECT_EQ(plan_with("", "series_step: 20 min").light.intervals.size(), 3 * 72u);
  // An hour is no divisor of these, three quarters are, cut at full hours.
  EXPECT_EQ(plan_with("", "series_step: 90 min").light.intervals.size(), 144u);
  EXPECT_EQ(plan_with("", "series: none").light.intervals.size(), 72u);
}

TEST(JoinedIntervals, AreOnlyWhereNothingIsAskedOfEachAndItPays) {
  const std::size_t minutes = 4320;
  for (const auto& [solver, output] : std::vector<std::pair<std::string, std::string>>{
           {"", ""},
           {"short_intervals: each", "series_step: 60 min"},
           {"year: each", "series_step: 60 min"},
           {"transport: shoot", "series_step: 60 min"},
           {"", "series: [total]"},
           {"accuracy: {irradiance_relative: 0.05}", "series: none"}})
    EXPECT_EQ(plan_with(solver, output).light.intervals.size(), minutes) << solver << output;
  // Two days have too few intervals with light, quarters of hours too few in an hour; but who asks
  // for it gets it.
  const std::string quarters = "start: 2026-06-01, end: 2026-06-11, step_min: 20";
  EXPECT_EQ(plan_with("", "series_step: 60 min", quarters).light.intervals.size(), 720u);
  EXPECT_EQ(plan_with("short_intervals: together", "series_step: 60 min", quarters)
                .light.intervals.size(),
            240u);
  const std::string short_one = "days: [2026-06-01], from: \"10:00\", to: \"12:30\", step_min: 5";
  EXPECT_EQ(plan_with("", "series_step: 30 min", short_one).light.intervals.size(), 30u);
  EXPECT_EQ(plan_with("short_intervals: together", "series_step: 30 min", short_one)
                .light.intervals.size(),
            5u);
}

double sum_of(const std::vector<SunSample>& suns, double SunSample::*share) {
  return std::accumulate(suns.begin(), suns.end(), 0.0,
                         [&](double sum, const SunSample& sun) { return sum + sun.*share; });
}

/// `full`: what light may be [W m-2, or lx].
void expect_light_of_parts(const std::string& light, double full) {
  const std::string days = "start: 2026-06-01, end: 2026-06-04, step_min: 1";
  const VariantPlan each = plan_with("short_intervals: each", "series_step: 60 min", days, light),
                    together = plan_with("", "series_step: 60 min", days, light);
  const SkyGrid grid;
  const IntervalLights lights(each.study, each.built.site, grid);
  std::size_t first = 0, with_sun = 0;
  for (std::size_t k = 0; k < together.light.intervals.size(); k += 5, first += 300) {
    const LitInterval& hour = together.light.intervals[k];
    const IntervalLight whole = lights.of(hour, k);
    double dni = 0, dhi = 0, ground = 0, sunlit_s = 0, up_s = 0;
    std::vector<double> sky;
    Vec3 beam;  // Σ DNI · direction: what a plane gets that faces all suns
    for (std::size_t p = first; p < first + 60; ++p) {
      const IntervalLight part = lights.of(each.light.intervals[p], p);
      dni += part.dni / 60, dhi += part.dhi / 60, ground += part.ground_exitance / 60;
      sunlit_s += part.sunlit_s;
      up_s += each.light.intervals[p].when.up_s;
      beam += part.direction * (part.dni / 60);
      sky.resize(std::max(sky.size(), part.sky.size()), 0);
      for (std::size_t c = 0; c < part.sky.size(); ++c) sky[c] += part.sky[c] / 60;
    }
    EXPECT_NEAR(whole.dni, dni, rounding * full);
    EXPECT_NEAR(whole.dhi, dhi, rounding * full);
    EXPECT_NEAR(whole.ground_exitance, ground, rounding * full);
    EXPECT_NEAR(whole.sunlit_s, sunlit_s, 1e-6);
    EXPECT_NEAR(hour.when.up_s, up_s, 1e-6);
    ASSERT_EQ(whole.sky.size(), sky.size());
    for (std::size_t c = 0; c < sky.size(); ++c) EXPECT_NEAR(whole.sky[c], sky[c], rounding * full);
    if (sunlit_s <= 0) {
      EXPECT_TRUE(whole.direct_suns.empty() && whole.sun_samples.empty());
      continue;
    }
    ++with_sun;
    EXPECT_TRUE(whole.has_sun());
    EXPECT_LE(whole.direct_suns.size(), 30u);
    EXPECT_LE(whole.sun_samples.size(), 3u);
    for (const auto* suns : {&whole.sun_samples, &whole.direct_suns}) {
      EXPECT_NEAR(sum_of(*suns, &SunSample::dni_share), 1, rounding);
      EXPECT_NEAR(sum_of(*suns, &SunSample::time_share), 1, rounding);
      Vec3 of_suns;
      for (const SunSample& sun : *suns) {
        EXPECT_GT(sun.direction.z, 0);
        EXPECT_NEAR(norm(sun.direction), 1, rounding);
        of_suns += sun.direction * (sun.dni_share * whole.dni);
      }
      // Means over 20 minutes are shorter than their directions by the half square of 2.5 degrees'
      // third.
      EXPECT_LT(norm(of_suns - beam), 1e-3 * whole.dni);
    }
  }
  EXPECT_GT(with_sun, 8u);
}

TEST(JoinedIntervals, HaveTheLightOfTheirParts) {
  expect_light_of_parts("source: clear_sky", 1000);
}

// Of which a low sun has less for its watts.
TEST(JoinedIntervals, HaveTheLumensOfTheirParts) {
  expect_light_of_parts("source: clear_sky, quantity: illuminance", 1e5);
}

/// Clocks go back by half an hour there: steps from midnight lie across hours from then on.
TEST(JoinedIntervals, LieInOneHourOfTheClockWhereClocksChangeByHalfAnHour) {
  const VariantPlan plan = plan_of(
      "format: sunload-study-1\nname: t\n"
      "site: {latitude_deg: -31.5, longitude_deg: 159.1, timezone: Australia/Lord_Howe}\n"
      "period: {start: 2026-04-04, end: 2026-04-07, step_min: 1}\nlight: {source: clear_sky}\n"
      "scene: {builtin: {name: street}}\nsolver: {short_intervals: together}\n"
      "output: {series: none}\n");
  // From the third hour of 5 April on, steps and hours cut each other in half.
  EXPECT_EQ(plan.light.intervals.size(), 24u + 47u + 24u);
  const TimeZone zone("Australia/Lord_Howe");
  for (const TimeSpan& span : plan.light.spans()) EXPECT_EQ(clock_hours(span, zone).size(), 1u);
}

TEST(JoinedIntervals, EndAtGapsAndAtTheEndOfThePeriod) {
  // Each day by itself from 10:30 to 12:45.
  const VariantPlan plan =
      plan_with("short_intervals: together", "series: none",
                "days: [2026-06-01, 2026-06-03], from: \"10:30\", to: \"12:45\", step_min: 5");
  std::vector<std::size_t> parts;
  for (const LitInterval& interval : plan.light.intervals)
    parts.push_back(std::max<std::size_t>(interval.parts().size(), 1));
  EXPECT_EQ(parts, (std::vector<std::size_t>{6, 12, 9, 6, 12, 9}));
}

}  // namespace
}  // namespace sunload::test
