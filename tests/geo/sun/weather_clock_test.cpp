// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Clocks of weather told by clear days: skies of own making, whose stamps are right or wrong. Each
// that must be silent has a twin of wrong stamps that must not.
#include "geo/sun/weather_clock.h"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <iostream>
#include <random>

#include "geo/sky/irradiance.h"

namespace sunload {
namespace {

constexpr double minute = seconds_per_minute;
constexpr double telling_s = 35 * minute;
const Site plain{.latitude_deg = 47, .longitude_deg = 8};
const Site south{.latitude_deg = -33.4, .longitude_deg = -70.8};

/// A sky over a place, seen by the sun's height and azimuth.
struct Sky {
  Site site = plain;
  double step_s = seconds_per_hour;
  int days = 365, first_day = 0;
  double cloudy = 0.6;     ///< share of days with clouds of their own in each record
  double fog_until_h = 0;  ///< solar hour, on four days of five
  double east_hills_deg = 0, west_hills_deg = 0;  ///< hide the sun, not the sky
};

Irradiance light_at(const Sky& sky, UnixTime time, const SunPosition& sun, double clouds) {
  Irradiance light = clear_sky(ClearSkyModel::ineichen, {.elevation_deg = sun.elevation_deg});
  const bool is_east = sun.azimuth_deg < 180;
  const double hills_deg = is_east ? sky.east_hills_deg : sky.west_hills_deg;
  const double solar_s = std::fmod(time + sky.site.longitude_deg * 240, seconds_per_day);
  const auto day = static_cast<int>((time + sky.site.longitude_deg * 240) / seconds_per_day);
  const bool is_foggy = day % 5 != 0 && solar_s < sky.fog_until_h * seconds_per_hour;
  const double beam = is_foggy || sun.elevation_deg < hills_deg ? 0 : 1 - clouds;
  light.dhi += (1 - beam) * 0.3 * (light.ghi - light.dhi) * (is_foggy ? 0.5 : clouds);
  light.dni *= beam;
  light.ghi = light.dni * std::sin(radians(std::max(0.0, sun.elevation_deg))) + light.dhi;
  return light;
}

using Shift = std::function<double(UnixTime)>;

Shift always(double shift_s) {
  return [=](UnixTime) { return shift_s; };
}

/// Stamps of clocks that are an hour ahead from April to October.
double summer_time(UnixTime time) {
  const int month = calendar_from_utc(time).month;
  return month >= 4 && month <= 10 ? seconds_per_hour : 0;
}

double southern_summer_time(UnixTime time) { return summer_time(time) > 0 ? 0 : seconds_per_hour; }

SunEphemeris sun_of(const Site& site, UnixTime begin, UnixTime end) {
  return {begin - 2 * seconds_per_day,
          end + 2 * seconds_per_day,
          site,
          Refraction::spa,
          Ut1::zero,
          standard_air(0)};
}

/// What a year's records say of it, stamped late by `late`.
std::vector<DatedWeather> weather_of(const Sky& sky, const Shift& late) {
  const UnixTime begin = utc_from_calendar({2021, 1, 1, 0, 0, 0}) + sky.first_day * seconds_per_day;
  const UnixTime end = begin + sky.days * seconds_per_day;
  const SunEphemeris sun = sun_of(sky.site, begin, end);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> chance(0, 1);
  std::vector<DatedWeather> weather;
  bool is_cloudy = false;
  for (UnixTime from = begin; from < end - 1; from += sky.step_s) {
    if (std::fmod(from, seconds_per_day) == 0) is_cloudy = chance(random) < sky.cloudy;
    const double clouds = is_cloudy ? chance(random) : 0;
    constexpr int parts = 4;
    Irradiance mean;
    for (int part = 0; part < parts; ++part) {
      const UnixTime at = from + (part + 0.5) / parts * sky.step_s;
      const Irradiance now = light_at(sky, at, sun(at), clouds);
      mean.dni += now.dni / parts;
      mean.dhi += now.dhi / parts;
      mean.ghi += now.ghi / parts;
    }
    const double shift_s = late(from);
    weather.push_back(
        {from + shift_s, from + sky.step_s + shift_s, {mean.dni, mean.dhi, mean.ghi}});
  }
  return weather;
}

WeatherClock clock_in(const Site& site, const std::vector<DatedWeather>& weather) {
  const SunEphemeris sun = sun_of(site, weather.front().begin, weather.back().end);
  return clock_of(weather, sun, site.latitude_deg, site.longitude_deg);
}

WeatherClock clock_of_sky(const Sky& sky, const Shift& late) {
  return clock_in(sky.site, weather_of(sky, late));
}

bool is_silent(const WeatherClock& clock) {
  return !clock.has_summer_time() && !clock.all.exceeds(telling_s);
}

TEST(WeatherClock, ShiftsAreToldAndMeasured) {
  for (const Site& site : {plain, south})
    for (const double late : {-480.0, -120.0, -60.0, -45.0, 45.0, 60.0, 120.0, 420.0}) {
      const WeatherClock clock = clock_of_sky({.site = site}, always(late * minute));
      EXPECT_TRUE(clock.all.exceeds(telling_s)) << late;
      EXPECT_NEAR(clock.all.whole.median / minute, late, 4);
      EXPECT_FALSE(clock.has_summer_time()) << late;
    }
}

TEST(WeatherClock, RightStampsOfAnyStepAreSilent) {
  for (const double step_min : {5.0, 10.0, 15.0, 30.0, 60.0}) {
    const Sky sky{.step_s = step_min * minute, .days = 120};
    const WeatherClock right = clock_of_sky(sky, always(0));
    EXPECT_TRUE(is_silent(right)) << step_min;
    EXPECT_NEAR(right.all.whole.median / minute, 0, 4) << step_min;
    EXPECT_GE(right.all.days, 20u) << step_min;
    EXPECT_FALSE(is_silent(clock_of_sky(sky, always(-45 * minute)))) << step_min;
  }
}

TEST(WeatherClock, SummerTimeInStampsIsToldAsSuch) {
  for (const auto& [site, late] :
       {std::pair(plain, Shift(summer_time)), std::pair(south, Shift(southern_summer_time))}) {
    const WeatherClock clock = clock_of_sky({.site = site}, late);
    EXPECT_TRUE(clock.has_summer_time());
    EXPECT_NEAR(clock.winter.whole.median / minute, 0, 5);
    EXPECT_NEAR(clock.summer.whole.median / minute, 60, 5);
    // Clocks go forward in summer, and not back.
    EXPECT_FALSE(
        clock_of_sky({.site = site}, [&](UnixTime t) { return -late(t); }).has_summer_time());
  }
  EXPECT_FALSE(clock_of_sky({.site = south}, summer_time).has_summer_time());
}

TEST(WeatherClock, HillsAreNoClock) {
  for (const double hills_deg : {5.0, 25.0, 40.0}) {
    EXPECT_TRUE(is_silent(clock_of_sky({.west_hills_deg = hills_deg}, always(0)))) << hills_deg;
    EXPECT_TRUE(is_silent(clock_of_sky({.east_hills_deg = hills_deg}, always(0)))) << hills_deg;
  }
  EXPECT_TRUE(is_silent(clock_of_sky({.step_s = 10 * minute, .west_hills_deg = 20}, always(0))));
  EXPECT_FALSE(is_silent(clock_of_sky({.west_hills_deg = 5}, always(seconds_per_hour))));
}

TEST(WeatherClock, FogIsNoClock) {
  for (const double until_h : {9.0, 11.0, 13.0}) {
    const Sky sky{.fog_until_h = until_h};
    EXPECT_TRUE(is_silent(clock_of_sky(sky, always(0)))) << until_h;
    EXPECT_FALSE(is_silent(clock_of_sky(sky, always(seconds_per_hour)))) << until_h;
  }
}

TEST(WeatherClock, FewDaysAndFewClearDaysTellNothing) {
  const auto hour_late = always(seconds_per_hour);
  EXPECT_TRUE(is_silent(clock_of_sky({.days = 9, .cloudy = 0}, hour_late)));
  EXPECT_FALSE(is_silent(clock_of_sky({.days = 14, .cloudy = 0}, hour_late)));
  EXPECT_TRUE(is_silent(clock_of_sky({.cloudy = 1}, always(0))));
  // No parts of a year are unlike: windows of a month, and of ten days of sun.
  for (int first_day = 0; first_day < 365; first_day += 30)
    EXPECT_TRUE(is_silent(clock_of_sky({.days = 30, .first_day = first_day}, always(0))));
  const WeatherClock none = clock_in(plain, {{0, 3600, {}}, {3600, 7200, {}}});
  EXPECT_EQ(none.all.days, 0u);
  EXPECT_TRUE(is_silent(none));
}

/// Files of the sunlit hours alone, and of beam and sky without their sum.
TEST(WeatherClock, RowsAndColumnsMayBeLeftOut) {
  for (const double late_min : {0.0, 60.0}) {
    auto weather = weather_of({}, always(late_min * minute));
    std::erase_if(weather, [](const DatedWeather& w) { return *w.values.ghi <= 0; });
    EXPECT_EQ(is_silent(clock_in(plain, weather)), late_min == 0);
    for (auto& w : weather) w.values.ghi = {};
    EXPECT_EQ(is_silent(clock_in(plain, weather)), late_min == 0);
    for (auto& w : weather) w.values.dhi = {};  // the beam alone, of which no light is made
    EXPECT_EQ(clock_in(plain, weather).all.days, 0u);
  }
}

TEST(WeatherClock, PolarDaysAndNightsAreNoShift) {
  const Site arctic{.latitude_deg = 78, .longitude_deg = 15};
  EXPECT_TRUE(is_silent(clock_of_sky({.site = arctic}, always(0))));
  EXPECT_FALSE(is_silent(clock_of_sky({.site = arctic}, always(seconds_per_hour))));
}

TEST(WeatherClock, YearOfMinutesIsFast) {
  const auto weather = weather_of({.step_s = minute}, always(0));
  ASSERT_EQ(weather.size(), 365u * 1440);
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_TRUE(is_silent(clock_in(plain, weather)));
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  std::cout << taken.count() * 1000 << " ms\n";
  EXPECT_LT(taken.count(), 1);  // some 70 ms; ten times and more for a busy machine
}

}  // namespace
}  // namespace sunload
