// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The clear sky's mean over an interval, against that of short ones.
#include "io/plan/light_series.h"

#include <gtest/gtest.h>

#include <string>

#include "io/plan/interval_lights.h"
#include "tests/support/study_plan.h"

namespace sunload::test {
namespace {

struct Sums {
  double dni = 0, dhi = 0, ghi = 0;
};

/// Radiant exposure of a day by steps of so many minutes [J m-2].
Sums day(const std::string& site, const std::string& date, int step_min) {
  const VariantPlan plan =
      plan_of("format: sunload-study-1\nname: day\nsite: {" + site + "}\nperiod: {days: [" + date +
              "], step_min: " + std::to_string(step_min) +
              "}\nlight: {source: clear_sky}\nscene: {builtin: {name: box_on_plane}}\n");
  Sums sums;
  for (const auto& interval : plan.light.intervals) {
    const double seconds = interval.when.length_s();
    sums.dni += interval.mean.dni * seconds;
    sums.dhi += interval.mean.dhi * seconds;
    sums.ghi += interval.mean.ghi * seconds;
  }
  return sums;
}

void expect_alike(const std::string& site, const std::string& date, int step_min, double share) {
  const Sums fine = day(site, date, 2), coarse = day(site, date, step_min);
  EXPECT_NEAR(coarse.dni, fine.dni, share * fine.dni) << site;
  EXPECT_NEAR(coarse.dhi, fine.dhi, share * fine.dhi) << site;
  EXPECT_NEAR(coarse.ghi, fine.ghi, share * fine.ghi) << site;
}

/// By clocks of UTC the sun of Hawaii and of Sydney sets and rises within one interval.
TEST(ClearSkyOfAnInterval, KnowsNightInItsMiddle) {
  for (const char* site : {"latitude_deg: 21, longitude_deg: -157, timezone: UTC",
                           "latitude_deg: -33.9, longitude_deg: 151.2, timezone: UTC"})
    for (const int step_min : {480, 1440}) expect_alike(site, "2026-06-21", step_min, 2e-3);
}

TEST(ClearSkyOfAnInterval, KnowsSunriseWithinAnHour) {
  expect_alike("latitude_deg: 50, longitude_deg: 14, timezone: UTC", "2026-03-21", 60, 5e-4);
}

/// Direct light of a winter's day on level ground, by the suns that stand for its steps [J m-2].
double direct_on_ground(int step_min, const std::string& suns) {
  const VariantPlan plan = plan_of(
      "format: sunload-study-1\nname: day\nsite: {latitude_deg: 50, longitude_deg: 14, timezone: "
      "UTC}\nperiod: {days: [2026-12-21], step_min: " +
      std::to_string(step_min) +
      "}\nlight: {source: clear_sky}\nscene: {builtin: {name: box_on_plane}}\n"
      "solver: {sun_samples_per_interval: " +
      suns + "}\n");
  const SkyGrid grid;
  double sum = 0;
  for (const IntervalLight& light : suns_of(plan, grid)) {
    if (light.sun_samples.empty()) sum += light.dni * light.direction.z * light.length_s;
    for (const SunSample& sun : light.sun_samples)
      sum += light.dni * sun.dni_share * sun.direction.z * light.length_s;
  }
  return sum;
}

/// A low sun brings less than a high one: suns of an hour that all brought its mean would take 1.2
/// % of a winter's day from level ground.
TEST(SunsOfAnInterval, BringWhatTheirHeightsHave) {
  const double fine = direct_on_ground(2, "1");
  EXPECT_NEAR(direct_on_ground(60, "auto"), fine, 2e-3 * fine);
  EXPECT_NEAR(direct_on_ground(60, "12"), fine, 1e-3 * fine);
  EXPECT_GT(fine - direct_on_ground(60, "1"), 4e-3 * fine) << "one sun stands for an hour";
}

}  // namespace
}  // namespace sunload::test
