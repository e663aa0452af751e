// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Which intervals are lit, and the light that the solver gets of them.
#include "io/plan/interval_lights.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "io/plan/variant_mesh.h"
#include "io/plan/work_estimate.h"
#include "tests/support/program.h"
#include "tests/support/study_plan.h"

namespace sunload {
namespace {

/// Midsummer at 50° north, hourly, by a file: diffuse light from 2 to 22 o'clock, sun from 3:53 to
/// 20:14, and at noon an hour of sun that the file gives no power.
VariantPlan day_with_twilight(const std::string& more = {}) {
  const test::WorkFolder folder;
  std::string csv =
      "# latitude_deg: 50\n# longitude_deg: 14\n# elevation_m: 250\n# utc_offset: +01:00\n"
      "time,dni_w_m2,dhi_w_m2\n";
  for (int hour = 1; hour <= 24; ++hour) {
    const bool diffuse = hour > 2 && hour <= 22 && hour != 12;
    csv += fmt::format("2026-06-21T{:02}:00,{},{}\n", hour, hour > 6 && hour < 12 ? 500 : 0,
                       diffuse ? 40 : 0);
  }
  const std::string weather = folder.write("day.csv", csv);
  return test::plan_of(
      "format: sunload-study-1\nname: t\nsite: {latitude_deg: 50, longitude_deg: 14}\n"
      "period: {year_of: weather}\nlight: {source: weather, weather: " +
      weather + ", stamp: end}\nscene: {builtin: {name: street}}\nsolver:\n  batch_suns: 5\n" +
      more);
}

std::size_t suns_of_batches(const VariantPlan& plan) {
  std::size_t suns = 0;
  for (std::size_t b = 0; b < plan.batches(); ++b) suns += sun_count(plan, b);
  return suns;
}

TEST(LitIntervals, AreThoseThatTheSolverComputes) {
  const VariantPlan plan = day_with_twilight();
  const SkyGrid grid;
  const auto suns = test::suns_of(plan, grid);
  ASSERT_EQ(suns.size(), 24u);
  std::size_t with_sun = 0;
  for (std::size_t k = 0; k < suns.size(); ++k) {
    EXPECT_EQ(is_dark(plan.light.intervals[k]), suns[k].is_dark()) << k;
    if (plan.light.intervals[k].when.sunlit_s > 0) ++with_sun;
  }
  // Twilight is lit though without sun, and noon though without power.
  EXPECT_EQ(with_sun, 18u);
  EXPECT_EQ(plan.light.lit_count(), 20u);
  EXPECT_EQ(suns_of_batches(plan), 20u);
}

TEST(LitIntervals, AreWhatWorkIsEstimatedFor) {
  const VariantPlan plan = day_with_twilight();
  VariantPlan night = plan;
  for (auto& interval : night.light.intervals)
    if (interval.when.sunlit_s <= 0) interval.mean.dhi = 0;
  EXPECT_EQ(night.light.lit_count(), 18u);
  constexpr std::size_t patches = 1000;
  EXPECT_GT(estimate_work(plan, patches).disk_bytes, estimate_work(night, patches).disk_bytes);
}

TEST(LitIntervals, AreWhatIsShotFor) {
  VariantPlan plan = day_with_twilight();
  plan.study.solver.transport = Transport::shoot;
  constexpr std::size_t patches = 1000;
  const auto of_day = estimate_work(plan, patches).samples;
  EXPECT_GT(of_day, 0u);
  for (auto& interval : plan.light.intervals) {
    interval.mean = {};
    interval.when.sunlit_s = 0;
  }
  ASSERT_EQ(plan.light.lit_count(), 0u);
  EXPECT_EQ(estimate_work(plan, patches).samples, 0u);
}

TEST(LitIntervals, AreAllWhereSomethingShines) {
  VariantPlan plan = day_with_twilight();
  plan.built.scene.materials.front().emission_w_m2 = 1;
  EXPECT_EQ(suns_of_batches(plan), 24u);
}

// A sun without power would take the place of one that has some.
TEST(LitIntervals, WithoutPowerAreNoneOfThePilots) {
  VariantPlan plan = day_with_twilight();
  auto& intervals = plan.light.intervals;
  const LitInterval morning = intervals[9], noon = intervals[11];
  ASSERT_GT(morning.mean.dni, 0);
  ASSERT_FALSE(is_dark(noon));
  intervals.assign(40, noon);
  intervals.insert(intervals.end(), 40, morning);
  for (const auto& sample : period_light(plan).samples)
    EXPECT_EQ(sample.size(), most_mesh_pilot_suns / 2);
}

// Tests of physics take their suns from here, as runs do.
TEST(IntervalLights, HaveTheSunsDisk) {
  const SkyGrid grid;
  for (const IntervalLight& sun : test::suns_of(day_with_twilight(), grid))
    EXPECT_EQ(sun.disk_half_angle, 0);
  const VariantPlan plan = day_with_twilight("sun: {disk: finite}\n");
  const auto suns = test::suns_of(plan, grid);
  for (std::size_t k = 0; k < suns.size(); ++k)
    EXPECT_EQ(suns[k].disk_half_angle,
              disk_half_angle(SunDisk::finite, plan.light.intervals[k].when.sun.distance_au));
  EXPECT_GT(suns[12].disk_half_angle, 0.004);
}

TEST(IntervalLights, HaveTheirNumberInThePeriod) {
  const VariantPlan plan = day_with_twilight();
  const SkyGrid grid;
  const auto some = IntervalLights(plan.study, plan.built.site, grid).of(plan.light, 7, 3);
  ASSERT_EQ(some.size(), 3u);
  EXPECT_EQ(some[2].number, 9u);
  EXPECT_EQ(some[2].direction.x, plan.light.intervals[9].when.direction.x);
}

TEST(IntervalLights, HaveAsManySunsAsTheStudyWants) {
  const SkyGrid grid;
  const VariantPlan one = day_with_twilight();
  EXPECT_EQ(one.light.sun_samples(), 18u);
  for (const auto& sun : test::suns_of(one, grid)) EXPECT_TRUE(sun.sun_samples.empty());
  // 17 hours and two thirds of one in the morning are three suns each but for the last, of 14
  // minutes, and the first, of 7: the same suns at the middle of each.
  const VariantPlan several = day_with_twilight("  sun_samples_per_interval: auto\n");
  std::size_t samples = 0;
  const auto suns = test::suns_of(several, grid);
  for (std::size_t k = 0; k < suns.size(); ++k) {
    const double sunlit_s = several.light.intervals[k].when.sunlit_s;
    EXPECT_EQ(std::max<std::size_t>(suns[k].sun_samples.size(), sunlit_s > 0),
              sunlit_s > 0 ? std::size_t(std::ceil(sunlit_s / 1200 - 1e-6)) : 0u);
    samples += std::max<std::size_t>(suns[k].sun_samples.size(), sunlit_s > 0);
  }
  EXPECT_EQ(several.light.sun_samples(), samples);
  EXPECT_GT(estimate_work(several, 1000).direct_rays, 5 * estimate_work(one, 1000).direct_rays / 2);
  EXPECT_NE(several.content_hash, one.content_hash);
}

}  // namespace
}  // namespace sunload
