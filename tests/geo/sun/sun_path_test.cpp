// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

#include "geo/sun/sun.h"
#include "tests/support/reference.h"

namespace sunload {
namespace {

using test::number;
using test::read_csv;
using test::Row;

constexpr double day_s = seconds_per_day;
// Instants are found to the resolution of a double [s].
constexpr double instant_resolution_s = 1e-6;

UnixTime instant(const std::string& text) { return utc_from_calendar(parse_time(text).civil); }

Site site_at(double latitude_deg, double longitude_deg) {
  Site site;
  site.latitude_deg = latitude_deg;
  site.longitude_deg = longitude_deg;
  return site;
}

SunEphemeris ephemeris(const Site& site, UnixTime begin, UnixTime end) {
  return {begin, end, site, Refraction::spa, Ut1::zero, standard_air(site.elevation_m)};
}

std::vector<PeriodStep> steps(UnixTime begin, UnixTime end, double step_s) {
  std::vector<PeriodStep> result;
  for (int i = 0; begin + (i + 1) * step_s <= end; ++i) {
    PeriodStep step;
    step.begin = begin + i * step_s;
    step.end = begin + (i + 1) * step_s;
    result.push_back(step);
  }
  return result;
}

SunPath path_of(const Site& site, UnixTime begin, UnixTime end, double step_s,
                Refraction refraction = Refraction::spa) {
  return sun_path(steps(begin, end, step_s), site, refraction, Ut1::zero);
}

TEST(SunEvents, ReferenceRiseTransitSet) {
  for (const auto& row : read_csv("01_solar_position/rise_transit_set.csv")) {
    SCOPED_TRACE(row.at("id"));
    const UnixTime midnight = instant(row.at("local_date"));
    const double utc_offset_s = number(row, "utc_offset_h") * 3600;
    // SPA looks for the events of the UTC day: what it prints as the sunset of 17 October in
    // Golden (17:20:19 local) is that of the evening before, 88 s later than the day's own.
    const bool utc_day = row.at("source").rfind("NREL", 0) == 0;
    const UnixTime begin = utc_day ? midnight : midnight - utc_offset_s;
    const Site site = site_at(number(row, "lat_deg"), number(row, "lon_deg_east"));
    const auto events = sun_events(ephemeris(site, begin, begin + day_s), begin);
    EXPECT_EQ(events.never_sets, row.at("type") == "ALL_DAY");
    EXPECT_EQ(events.never_rises, row.at("type") == "ALL_NIGHT");
    EXPECT_EQ(events.rise.has_value(), row.at("type") == "NORMAL");
    EXPECT_EQ(events.set.has_value(), row.at("type") == "NORMAL");
    const auto check = [&](const std::optional<UnixTime>& event, const char* column) {
      if (row.at(column).empty()) return;
      ASSERT_TRUE(event.has_value());
      const double offset_s = *event + utc_offset_s - midnight - parse_time_of_day(row.at(column));
      // The time of day is what the tables print.
      EXPECT_LE(std::abs(std::remainder(offset_s, day_s)), number(row, "tol_s")) << column;
    };
    check(events.rise, "sunrise_local");
    check(events.transit, "transit_local");
    check(events.set, "sunset_local");
  }
}

TEST(SunEvents, ReferencePolarAndExtremes) {
  for (const auto& row : read_csv("01_solar_position/polar_and_extremes.csv")) {
    SCOPED_TRACE(row.at("id"));
    const UnixTime begin = instant(row.at("utc_date"));
    const auto sun = ephemeris(site_at(number(row, "lat_deg"), number(row, "lon_deg_east")), begin,
                               begin + day_s);
    UnixTime lowest = begin, highest = begin;
    const auto height = [&](UnixTime t) { return sun(t).true_elevation_deg; };
    constexpr double step_s = 5;  // 0.0014 h; the tolerance is 0.01 h
    for (UnixTime t = begin; t < begin + day_s; t += step_s) {
      if (height(t) < height(lowest)) lowest = t;
      if (height(t) > height(highest)) highest = t;
    }
    const double tolerance_deg = number(row, "tol_deg"), tolerance_h = number(row, "tol_h");
    test::expect_reference("elev_min_deg", height(lowest), number(row, "elev_min_deg"),
                           tolerance_deg);
    test::expect_reference("elev_max_deg", height(highest), number(row, "elev_max_deg"),
                           tolerance_deg);
    test::expect_reference("utc_h_min", (lowest - begin) / 3600, number(row, "utc_h_min"),
                           tolerance_h);
    test::expect_reference("utc_h_max", (highest - begin) / 3600, number(row, "utc_h_max"),
                           tolerance_h);
    const auto events = sun_events(sun, begin);
    EXPECT_EQ(events.never_sets, row.at("state") == "day");
    EXPECT_EQ(events.never_rises, row.at("state") == "night");
    EXPECT_EQ(events.rise && events.set, row.at("state") == "rise_and_set");
    EXPECT_LE(events.transit, begin + day_s + 60);
    // The sun culminates within minutes of its meridian passage.
    EXPECT_NEAR(std::remainder(events.transit - highest, day_s), 0, 300);
  }
}

TEST(SunEvents, PolesHaveOneSunriseAYear) {
  for (const double latitude : {90.0, -90.0, 89.99}) {
    const UnixTime begin = instant("2026-01-01"), end = begin + 365 * day_s;
    const auto sun = ephemeris(site_at(latitude, 0), begin, end);
    const auto crossings = elevation_crossings(sun, begin, end, -0.8333);
    EXPECT_GE(crossings.size(), 2U);
    EXPECT_EQ(crossings.size() % 2, 0U);
    if (std::abs(latitude) == 90) {
      EXPECT_EQ(crossings.size(), 2U);
    }
    for (UnixTime day = begin; day < end; day += 10 * day_s) {
      const auto events = sun_events(sun, day);
      EXPECT_TRUE(std::isfinite(events.transit));
      EXPECT_FALSE(events.never_rises && events.never_sets);
    }
  }
}

TEST(SunEvents, ShortestDipsAcrossTheHorizonAreFound) {
  // Thresholds a hair within the extremes of a day: two passages some seconds apart.
  const UnixTime begin = instant("2026-06-21"), end = begin + day_s;
  const auto sun = ephemeris(site_at(69.65, 18.96), begin, end);
  double lowest = 90, highest = -90;
  for (UnixTime t = begin; t < end; t += 1) {
    const double e = sun(t).true_elevation_deg;
    lowest = std::min(lowest, e);
    highest = std::max(highest, e);
  }
  constexpr double hair_deg = 1e-6;
  for (const double threshold : {lowest + hair_deg, highest - hair_deg}) {
    const auto crossings = elevation_crossings(sun, begin, end, threshold);
    ASSERT_EQ(crossings.size(), 2U) << threshold;
    EXPECT_LT(crossings[1].time - crossings[0].time, 60);
    EXPECT_NE(crossings[0].sense, crossings[1].sense);
  }
  EXPECT_TRUE(elevation_crossings(sun, begin, end, lowest - hair_deg).empty());
  EXPECT_TRUE(elevation_crossings(sun, begin, end, highest + hair_deg).empty());
}

// What every interval must be, whatever its length and place.
void expect_consistent(const SunPath& path, const Site& site, Refraction refraction) {
  const Air air = standard_air(site.elevation_m);
  const SunEphemeris sun(path.front().begin, path.back().end, site, refraction, Ut1::zero, air);
  for (const auto& interval : path) {
    SCOPED_TRACE(interval.begin);
    ASSERT_GE(interval.sunlit_s, 0);
    ASSERT_LE(interval.sunlit_s, interval.length_s() + instant_resolution_s);
    ASSERT_GE(interval.sun_time, interval.begin);
    ASSERT_LE(interval.sun_time, interval.end);
    ASSERT_NEAR(norm(interval.direction), 1, 1e-12);
    ASSERT_EQ(interval.sun.elevation_deg, sun(interval.sun_time).elevation_deg);
    if (interval.sunlit_s == 0) {
      ASSERT_EQ(interval.sun_time, (interval.begin + interval.end) / 2);
      ASSERT_LE(interval.sun.elevation_deg, 0);
      ASSERT_LE(sun(interval.begin).elevation_deg, 0);
      ASSERT_LE(sun(interval.end).elevation_deg, 0);
      continue;
    }
    // A sliver shorter than this has its sun on the horizon to rounding.
    if (interval.sunlit_s > instant_resolution_s) {
      ASSERT_GT(interval.sun.elevation_deg, 0);
    }
    ASSERT_GE(interval.sunlit_begin, interval.begin);
    ASSERT_LE(interval.sunlit_end, interval.end);
    // Bounds inside of the interval lie on the apparent horizon.
    constexpr double second = 1;
    if (interval.sunlit_begin > interval.begin) {
      ASSERT_LE(sun(interval.sunlit_begin - second).elevation_deg, 0);
    }
    if (interval.sunlit_end < interval.end) {
      ASSERT_LE(sun(interval.sunlit_end + second).elevation_deg, 0);
    }
  }
}

TEST(SunPath, IsConsistentEverywhere) {
  const UnixTime begin = instant("2026-01-01"), end = begin + 365 * day_s;
  for (const double latitude : {-90.0, -77.8, -33.9, 0.0, 51.5, 66.6, 78.2, 90.0}) {
    const Site site = site_at(latitude, 15);
    for (const double step_s : {3600.0, 6 * 3600.0, day_s, 30 * day_s}) {
      SCOPED_TRACE(std::to_string(latitude) + " " + std::to_string(step_s));
      expect_consistent(path_of(site, begin, end, step_s), site, Refraction::spa);
    }
  }
}

TEST(SunPath, IsConsistentForEveryRefraction) {
  const UnixTime begin = instant("2026-01-01"), end = begin + 365 * day_s;
  const Site site = site_at(66.6, 15);
  for (const auto refraction : {Refraction::none, Refraction::spa, Refraction::bennett}) {
    expect_consistent(path_of(site, begin, end, 6 * 3600, refraction), site, refraction);
  }
}

TEST(SunPath, SunlitTimeDoesNotDependOnTheSteps) {
  // 35 000 quarters of an hour, each with bounds to 2.4e-7 s (the last digit of a double).
  constexpr double tolerance_s = 0.02;
  const UnixTime begin = instant("2026-01-01"), end = begin + 360 * day_s;
  for (const double latitude : {-90.0, 0.0, 51.5, 67.2, 78.2}) {
    const Site site = site_at(latitude, -70);
    const auto total = [&](double step_s) {
      double sum = 0;
      for (const auto& interval : path_of(site, begin, end, step_s)) sum += interval.sunlit_s;
      return sum;
    };
    const double whole = total(360 * day_s);
    for (const double step_s : {900.0, 3600.0, day_s}) {
      EXPECT_NEAR(total(step_s), whole, tolerance_s) << latitude << ' ' << step_s;
    }
  }
}

TEST(SunPath, PartlySunlitIntervalHasTheMiddleOfItsSunlitPart) {
  const Site site = site_at(51.5, 0);
  const UnixTime begin = instant("2026-03-20T06:00");
  const auto path = path_of(site, begin, begin + 3600, 3600);
  ASSERT_EQ(path.size(), 1U);
  const auto& interval = path.front();
  EXPECT_GT(interval.sunlit_begin, begin);
  EXPECT_EQ(interval.sunlit_end, interval.end);
  EXPECT_NEAR(interval.sun_time, (interval.sunlit_begin + interval.end) / 2, instant_resolution_s);
  EXPECT_NEAR(interval.sunlit_s, interval.end - interval.sunlit_begin, instant_resolution_s);
}

TEST(SunPath, SeveralPartsAreCountedAndTheLongestHasTheSun) {
  // A UTC day in the Pacific: evening first, then night, then the longer morning.
  const Site site = site_at(-18, 160);
  const UnixTime begin = instant("2026-03-21");
  const auto interval = path_of(site, begin, begin + day_s, day_s).front();
  EXPECT_EQ(interval.sunlit_begin, begin);
  EXPECT_EQ(interval.sunlit_end, begin + day_s);
  EXPECT_NEAR(interval.sunlit_s, 12.1 * 3600, 0.1 * 3600);  // equinox and refraction
  EXPECT_GT(interval.sun.elevation_deg, 30);
}

TEST(SunPath, PolarDayAndNight) {
  const Site site = site_at(78.22, 15.65);
  const UnixTime june = instant("2026-06-21"), december = instant("2026-12-21");
  const auto day = path_of(site, june, june + day_s, day_s).front();
  EXPECT_EQ(day.sunlit_s, day_s);
  EXPECT_EQ(day.sun_time, june + day_s / 2);
  const auto night = path_of(site, december, december + day_s, day_s).front();
  EXPECT_EQ(night.sunlit_s, 0);
  EXPECT_EQ(night.sun_time, december + day_s / 2);
  EXPECT_LT(night.sun.elevation_deg, 0);
}

TEST(SunPath, GivenInstantsStayWhereTheyAre) {
  const Site site = site_at(51.5, 0);
  PeriodStep step;
  step.instant = instant("2026-03-20T06:00");
  step.begin = step.instant - 1800;
  step.end = step.instant + 1800;
  step.rule = SunInstant::given;
  const auto interval = sun_path({step}, site, Refraction::spa, Ut1::zero).front();
  EXPECT_EQ(interval.sun_time, step.instant);
  EXPECT_LT(interval.sun.elevation_deg, 0);
  // Part of the interval has sun, but not from where the sun stands at that instant.
  EXPECT_EQ(interval.sunlit_s, 0);
  EXPECT_GT(interval.up_s, 0);
  EXPECT_LT(interval.up_s, 1800);
}

TEST(SunPath, DirectionIsInTheSceneFrame) {
  Site site = site_at(49.7475, 13.3776);
  const UnixTime begin = instant("2026-06-21T09:00");
  const auto plain = path_of(site, begin, begin + 3600, 3600).front();
  site.north_deg = 30;
  const auto turned = path_of(site, begin, begin + 3600, 3600).front();
  EXPECT_EQ(plain.sun.azimuth_deg, turned.sun.azimuth_deg);
  EXPECT_NEAR(horizontal(plain.direction).azimuth_deg, plain.sun.azimuth_deg, 1e-10);
  EXPECT_NEAR(horizontal(turned.direction).azimuth_deg, plain.sun.azimuth_deg - 30, 1e-10);
  EXPECT_NEAR(horizontal(turned.direction).elevation_deg, plain.sun.elevation_deg, 1e-10);
}

// The suns of an hour are those that its parts would have each.
TEST(SunSamples, StandAtTheMiddleOfEqualPartsOfTheSun) {
  const Site site = site_at(49.7475, 13.3776);
  const UnixTime begin = instant("2026-06-21T09:00");
  const auto hour =
      sun_path(steps(begin, begin + 3600, 3600), site, Refraction::spa, Ut1::zero, {.count = 4})
          .front();
  const auto quarters = path_of(site, begin, begin + 3600, 900);
  ASSERT_EQ(hour.sun_samples.size(), quarters.size());
  for (std::size_t s = 0; s < quarters.size(); ++s)
    EXPECT_LT(norm(hour.sun_samples[s] - quarters[s].direction), 1e-12) << s;
  EXPECT_EQ(hour.direction.x, path_of(site, begin, begin + 3600, 3600).front().direction.x);
}

TEST(SunSamples, LieWithinTheSunlitParts) {
  // The day of a whole step has its night in the middle: 00:00 UTC is noon at 180 degrees.
  const Site site = site_at(40, 180);
  const UnixTime noon = instant("2026-03-20T00:00");
  constexpr int count = 101;
  const auto day =
      sun_path(steps(noon, noon + day_s, day_s), site, Refraction::spa, Ut1::zero, {count}).front();
  ASSERT_EQ(day.sun_samples.size(), static_cast<std::size_t>(count));
  int west = 0;
  for (const Vec3 w : day.sun_samples) {
    EXPECT_GT(w.z, 0);
    west += w.x < 0;
  }
  // Half of the day's sun is that of the afternoon, which comes first here but for some minutes
  // (equation of time).
  EXPECT_NEAR(west, count / 2.0, 1.5);
  EXPECT_LT(day.sun_samples[count / 4].x, 0);
  EXPECT_GT(day.sun_samples[3 * count / 4].x, 0);
}

TEST(SunSamples, AreAsManyAsAskedForOrOneForTwentyMinutes) {
  EXPECT_EQ(sun_sample_count({}, 3600), 1);
  EXPECT_EQ(sun_sample_count({.count = 5}, 60), 5);
  const SunSamples automatic{.count = {}};
  for (const auto& [sunlit_s, count] :
       {std::pair{0.0, 1}, {900, 1}, {1200, 1}, {1201, 2}, {3600, 3}})
    EXPECT_EQ(sun_sample_count(automatic, sunlit_s), count) << sunlit_s;
  // An instant is one.
  const Site site = site_at(51.5, 0);
  const UnixTime noon = instant("2026-03-20T12:00");
  const PeriodStep given{noon - 1800, noon + 1800, noon, SunInstant::given};
  EXPECT_TRUE(sun_path({given}, site, Refraction::spa, Ut1::zero, {.count = 4})
                  .front()
                  .sun_samples.empty());
}

TEST(SunPath, RefusesStepsOutOfOrder) {
  const Site site = site_at(0, 0);
  auto backwards = steps(0, 7200, 3600);
  std::swap(backwards[0], backwards[1]);
  EXPECT_THROW(sun_path(backwards, site, Refraction::none, Ut1::zero), std::logic_error);
  EXPECT_TRUE(sun_path({}, site, Refraction::none, Ut1::zero).empty());
}

TEST(SunPath, IsFast) {
  const UnixTime begin = instant("2026-01-01");
  const auto start = std::chrono::steady_clock::now();
  const auto path = path_of(site_at(51.99, 4.36), begin, begin + 365 * day_s, 3600);
  const double taken =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::cout << path.size() << " hourly intervals: " << taken * 1000 << " ms\n";
  EXPECT_LT(taken, 1);  // some 50 ms; ten times and more for a busy machine
}

/// A day with hills all around.
SunPath path_behind(const Horizon& hills, UnixTime begin, UnixTime end, double step_s) {
  Site site = site_at(50, 14);
  site.horizon = hills;
  return path_of(site, begin, end, step_s);
}

TEST(SunPathWithHills, LevelHillsAreALaterSunrise) {
  // Against the crossing of the elevation itself, without refraction: one and the same line.
  const UnixTime begin = instant("2026-03-21T00:00"), end = begin + day_s;
  Site site = site_at(50, 14);
  site.horizon = Horizon({{0, 10}});
  const SunEphemeris sun(begin, end, site, Refraction::none, Ut1::zero, standard_air(0));
  const auto crossings = elevation_crossings(sun, begin, end, 10);
  ASSERT_EQ(crossings.size(), 2u);
  const auto path = path_of(site, begin, end, day_s, Refraction::none);
  ASSERT_EQ(path.size(), 1u);
  EXPECT_NEAR(path[0].sunlit_begin, crossings[0].time, instant_resolution_s);
  EXPECT_NEAR(path[0].sunlit_end, crossings[1].time, instant_resolution_s);
  EXPECT_NEAR(path[0].sunlit_s, crossings[1].time - crossings[0].time, 2 * instant_resolution_s);
  EXPECT_LT(path[0].up_begin, path[0].sunlit_begin);
  EXPECT_GT(path[0].up_end, path[0].sunlit_end);
}

TEST(SunPathWithHills, OpenHorizonChangesNothing) {
  const UnixTime begin = instant("2026-03-21T00:00"), end = begin + day_s;
  const auto open = path_behind({}, begin, end, 3600);
  const auto flat = path_behind(Horizon({{0, 0}, {180, 0}}), begin, end, 3600);
  for (std::size_t i = 0; i < open.size(); ++i) {
    EXPECT_EQ(open[i].sunlit_s, open[i].up_s);
    EXPECT_EQ(open[i].sunlit_begin, open[i].up_begin);
    // The crossing of the apparent and that of the true elevation differ by rounding.
    EXPECT_NEAR(open[i].sunlit_s, flat[i].sunlit_s, 10 * instant_resolution_s);
    EXPECT_NEAR(open[i].sun_time, flat[i].sun_time, 10 * instant_resolution_s);
  }
}

TEST(SunPathWithHills, HiddenAndPartlyHiddenIntervals) {
  const UnixTime begin = instant("2026-03-21T00:00"), end = begin + day_s;
  // A mountain in the south alone, above the noon sun (40 degrees), from azimuth 160 to 200.
  const Horizon mountain({{159, 0}, {160, 60}, {200, 60}, {201, 0}});
  double sunlit_s = 0, up_s = 0;
  int parts = 0;
  for (const auto& interval : path_behind(mountain, begin, end, 600)) {
    sunlit_s += interval.sunlit_s;
    up_s += interval.up_s;
    const bool above = mountain.is_above({interval.sun.azimuth_deg, interval.sun.elevation_deg});
    EXPECT_EQ(interval.sunlit_s > 0, above && interval.sun.elevation_deg > 0);
    if (interval.sunlit_s > 0 && interval.sunlit_s < interval.up_s) ++parts;
    EXPECT_GE(interval.sunlit_begin, interval.up_begin);
    EXPECT_LE(interval.sunlit_end, interval.up_end);
  }
  EXPECT_EQ(parts, 2);
  // The whole day as one interval: two sunlit parts, the sun of the longer.
  const auto day = path_behind(mountain, begin, end, day_s);
  EXPECT_NEAR(day[0].sunlit_s, sunlit_s, 1e-4);
  EXPECT_NEAR(day[0].up_s, up_s, 1e-4);
  EXPECT_TRUE(mountain.is_above({day[0].sun.azimuth_deg, day[0].sun.elevation_deg}));
  // Hills around everything: no sun, but the day is still the day.
  const auto valley = path_behind(Horizon({{0, 80}}), begin, end, day_s);
  EXPECT_EQ(valley[0].sunlit_s, 0);
  EXPECT_NEAR(valley[0].up_s, up_s, 1e-4);
  EXPECT_GT(valley[0].sun.elevation_deg, 30);
}

TEST(SunPathWithHills, AnInstantBehindThemHasNoSun) {
  Site site = site_at(50, 14);
  site.horizon = Horizon({{0, 20}});
  const UnixTime noon = instant("2026-03-21T11:00"), early = instant("2026-03-21T06:00");
  const auto given = [](UnixTime t) {
    return PeriodStep{t - 1800, t + 1800, t, SunInstant::given};
  };
  const auto path = sun_path({given(early), given(noon)}, site, Refraction::spa, Ut1::zero);
  EXPECT_EQ(path[0].sunlit_s, 0);
  EXPECT_GT(path[0].up_s, 0);
  EXPECT_EQ(path[1].sunlit_s, 3600);
}

}  // namespace
}  // namespace sunload
