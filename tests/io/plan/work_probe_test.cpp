// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A little of a variant's work, by which its time is estimated.
#include "io/plan/work_probe.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/plan/variant_mesh.h"
#include "tests/support/study_plan.h"

namespace sunload {
namespace {

std::string study(const std::string& house, const std::string& period) {
  return "format: sunload-study-1\nname: t\n"
         "site: {latitude_deg: 50, longitude_deg: 14, timezone: Europe/Prague}\n"
         "period: {" +
         period +
         "}\nlight: {source: clear_sky}\n"
         "scene: {builtin: {name: street, house_3: " +
         house +
         "}}\n"
         "mesh: {max_edge_m: 20, oracle: none}\nsolver: {bounces: 2}\n";
}
const std::string one_day = "days: [2026-06-21], step_min: 60",
                  night = "days: [2026-06-21], from: \"00:00\", to: \"01:00\", step_min: 60";

TEST(WorkProbe, MeasuresEveryStageThatThereIs) {
  const auto glazed = test::plan_of(study("glazed", one_day));
  const auto pace = measured_pace(glazed, unrefined_mesh(glazed).mesh);
  ASSERT_TRUE(pace);
  EXPECT_TRUE(pace->is_measured);
  for (const double stage : {pace->lines, pace->direct, pace->mirror, pace->solve}) {
    EXPECT_GT(stage, 0);
    EXPECT_NE(stage, 1);  // which stands for what was not measured
  }
}

/// What sensors take is told beside what patches take, and changes nothing of that.
TEST(WorkProbe, MeasuresSensorsByThemselves) {
  const std::string few = study("brick", one_day);
  std::string many = few + "sensors: {points: [";
  for (int i = 0; i < 500; ++i)
    many += "{position_m: [" + std::to_string(i % 25 - 12) + ", 0, 30], normal: [0, 0, 1]}, ";
  many += "]}\n";
  const auto without = test::plan_of(few), with = test::plan_of(many);
  constexpr std::size_t patches = 10'000;
  const BlockCounts block{.lines_per_patch = 64, .direct_samples = 16, .suns = 16};
  const WorkSeconds a = modelled_seconds(without, patches, block),
                    b = modelled_seconds(with, patches, block);
  EXPECT_EQ(a.lines, b.lines);
  EXPECT_EQ(a.direct, b.direct);
  EXPECT_EQ(a.solve, b.solve);
  EXPECT_EQ(a.sensors, 0);
  EXPECT_GT(b.sensors, 0);
  const auto pace = measured_pace(with, unrefined_mesh(with).mesh);
  ASSERT_TRUE(pace);
  EXPECT_NE(pace->sensors, 1);
  // Each looks at every sun of the day with each of its samples.
  const double rays = static_cast<double>(estimate_work(with, patches).direct_rays) -
                      static_cast<double>(estimate_work(without, patches).direct_rays);
  const double suns = static_cast<double>(with.light.sun_samples());
  EXPECT_NEAR(rays, 500 * suns * with.study.solver.direct_samples, 500);
  WorkPace slow;
  slow.sensors = 10;
  EXPECT_GT(estimate_work(with, patches, slow).seconds, estimate_work(with, patches).seconds);
}

/// Low suns cost many times what high ones do, and suns of one hour of many days less together.
TEST(WorkProbe, TriesNeighboursLowAndHigh) {
  const auto plan =
      test::plan_of(study("brick", "start: 2026-05-01, end: 2026-09-01, step_min: 60"));
  const auto height = [&](std::size_t k) { return plan.light.intervals[k].when.direction.z; };
  const auto tried = tried_intervals(plan, 12);
  ASSERT_EQ(tried.size(), 12u);
  for (std::size_t place = 0; place < 12; place += 4)
    for (std::size_t i = place + 1; i < place + 4; ++i) {
      const double cosine = dot(plan.light.intervals[tried[i]].when.direction,
                                plan.light.intervals[tried[place]].when.direction);
      EXPECT_GT(cosine, std::cos(0.2)) << i;  // an hour is 0.26 of the sky's turn
    }
  EXPECT_LT(height(tried[0]), std::sin(0.25));  // a sixth of the way to noon
  EXPECT_GT(height(tried[4]), height(tried[0]));
  EXPECT_GT(height(tried[8]), height(tried[4]));
  EXPECT_EQ(tried_intervals(plan, 0.1).size(), 1u);
  EXPECT_EQ(tried_intervals(plan, 1e9).size(), block_width);
}

TEST(WorkProbe, HasNothingToMeasureAtNight) {
  const auto dark = test::plan_of(study("brick", night));
  const auto mesh = unrefined_mesh(dark).mesh;
  EXPECT_FALSE(measured_pace(dark, mesh));
  EXPECT_FALSE(StudyPaces().of(dark, mesh).is_measured);
}

TEST(WorkProbe, IsMadeOnceForVariantsThatAreMuchAlike) {
  StudyPaces paces;
  const auto first = test::plan_of(study("glazed", one_day)),
             second = test::plan_of(study("brick", one_day));
  const WorkPace a = paces.of(first, unrefined_mesh(first).mesh);
  const WorkPace b = paces.of(second, unrefined_mesh(second).mesh);  // its windows are mirrors, too
  EXPECT_EQ(a.lines, b.lines);
  EXPECT_EQ(a.direct, b.direct);
}

/// Gathered lines look for lamps: a trial that forgot it would take them for slow.
TEST(WorkProbe, KnowsWhatLampsCost) {
  const std::string brick = study("brick", one_day);
  std::string lamps = brick;
  lamps.replace(lamps.find("scene: {"), 8,
                "scene: {materials: {brick: {diffuse: 0.3, emission_w_m2: 5}}, ");
  constexpr std::size_t patches = 10'000;
  const BlockCounts counts{.lines_per_patch = 64, .direct_samples = 16, .suns = 16};
  const double without = modelled_seconds(test::plan_of(brick), patches, counts).lines;
  EXPECT_GT(modelled_seconds(test::plan_of(lamps), patches, counts).lines, 1.5 * without);
}

/// Every stage of the estimate takes as much longer as the trial did; starting and files do not.
TEST(WorkProbe, ScalesTheStagesOfTheEstimate) {
  const auto plan = test::plan_of(study("glazed", one_day));
  constexpr std::size_t patches = 100'000;
  const auto seconds = [&](const WorkPace& pace) {
    return estimate_work(plan, patches, pace).seconds;
  };
  const double usual = seconds({});
  const WorkPace all{.lines = 2, .direct = 2, .mirror = 2, .solve = 2};
  double stages = 0;
  for (double WorkPace::*stage :
       {&WorkPace::lines, &WorkPace::direct, &WorkPace::mirror, &WorkPace::solve}) {
    WorkPace slow;
    slow.*stage = 2;
    const double more = seconds(slow) - usual;
    EXPECT_GT(more, 0);
    stages += more;
  }
  EXPECT_NEAR(seconds(all) - usual, stages, 1e-9 * usual);
  EXPECT_LT(stages, usual);
  EXPECT_GT(stages, 0.9 * usual);
}

}  // namespace
}  // namespace sunload
