// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Weather of a study: its own steps and others, years, missing values, site, hash, time it takes.
#include "io/plan/weather_light.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <iostream>

#include "io/plan/interval_lights.h"
#include "io/plan/light_series.h"
#include "io/plan/planner.h"
#include "io/plan/scene_build.h"
#include "io/plan/variant_plan.h"
#include "tests/support/real_models.h"
#include "tests/support/refusal_of.h"
#include "tests/support/scene_text.h"
#include "tests/support/small_weather.h"

namespace sunload {
namespace {

using test::write_text;

const std::string weather_folder = "data/weather/";

Study weather_study(const std::string& site, const std::string& period, const std::string& light) {
  write_text("flat.obj", "v 0 0 0\nv 10 0 0\nv 0 10 0\nf 1 2 3\n");
  const std::string text = fmt::format(
      "format: sunload-study-1\nname: w\n{}period: {{{}}}\nlight: {{source: weather, {}}}\n"
      "scene: {{files: [flat.obj]}}\n",
      site.empty() ? "" : "site: {" + site + "}\n", period, light);
  return read_study(write_text("w.yaml", text)).variants.front();
}

std::string shared(const std::string& name) {
  return "weather: " + test::shared_path(weather_folder + name);
}

LightSeries series_of(const Study& study) { return light_series(study, build_scene(study).site); }

std::string refused(const Study& study) {
  return test::refusal_of([&] { series_of(study); });
}

bool tells(const std::vector<std::string>& lines, const std::string& part) {
  for (const auto& line : lines)
    if (line.find(part) != line.npos) return true;
  return false;
}

/// A day of hours that ends at midnight, with an offset from UTC of `offset_h`.
std::string csv_day(const std::string& date, const std::string& row_values,
                    const std::string& columns, const std::string& head) {
  std::string text = head + "time," + columns + "\n";
  for (int hour = 1; hour <= 24; ++hour)
    text += fmt::format("{}T{:02}:00,{}\n", date, hour, row_values);
  return text;
}

const std::string roof =
    "# place: Roof\n# latitude_deg: 50\n# longitude_deg: 14\n# elevation_m: 250\n"
    "# utc_offset: +01:00\n";

TEST(WeatherLight, YearOfAnEpwIsItsRecordsAndFast) {
  SUNLOAD_NEEDS_MODEL(weather_folder + "WD100_denver.epw");
  const Study study = weather_study("", "year_of: weather", shared("WD100_denver.epw"));
  const auto built = build_scene(study);
  EXPECT_NE(built.site_source.find("weather station Denver"), std::string::npos);
  EXPECT_EQ(built.site.latitude_deg, 39.833);
  EXPECT_EQ(built.site.elevation_m, 1650);
  const auto begin = std::chrono::steady_clock::now();
  const auto series = light_series(study, built.site);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  std::cout << series.intervals.size() << " intervals: " << taken.count() * 1000 << " ms\n";
  EXPECT_LT(taken.count(), 5);  // some 125 ms; a busy machine may take ten times as long
  ASSERT_EQ(series.intervals.size(), 8760u);
  const auto file = read_weather_file(study.light.weather, {});
  double dropped = 0, ghi = 0;
  for (std::size_t i = 0; i < series.intervals.size(); ++i) {
    const LitInterval& lit = series.intervals[i];
    const WeatherValues& values = file.records[i].values;
    EXPECT_EQ(lit.mean.dhi, *values.dhi);
    EXPECT_EQ(lit.mean.ghi, *values.ghi);
    ghi += lit.mean.ghi / 1000;
    if (lit.when.sunlit_s > 0) {
      EXPECT_EQ(lit.mean.dni, *values.dni);
    } else {
      EXPECT_EQ(lit.mean.dni, 0);
      dropped += *values.dni;
    }
  }
  EXPECT_NEAR(ghi, 1670, 0.5);  // README of the weather files, whole kWh
  EXPECT_EQ(tells(series.weather, "of direct light dropped"), dropped > 0);
  EXPECT_TRUE(tells(series.weather, "typical year written as 2001"));
  EXPECT_TRUE(tells(series.weather, "closure DNI sin(elevation) + DHI - GHI"));
  EXPECT_EQ(iso_utc(series.intervals.front().when.begin), "2001-01-01T07:00:00Z");
  EXPECT_TRUE(series.notes.empty());
}

TEST(WeatherLight, TypicalYearsSayThatTheyHaveNoLeapDay) {
  write_text("typical.epw", test::small_epw());
  const auto why = [](const std::string& day) {
    return refused(
        weather_study("timezone: Europe/Berlin", "days: [" + day + "]", "weather: typical.epw"));
  };
  EXPECT_NE(why("2024-02-29").find("have no 29 February"), std::string::npos) << why("2024-02-29");
  EXPECT_EQ(why("2024-02-28"), "");
}

TEST(WeatherLight, SolverGetsDiffuseLightInTheDark) {
  const auto file =
      write_text("day.csv", csv_day("2026-06-21", "100,40", "dni_w_m2,dhi_w_m2", roof));
  const Study study = weather_study("", "year_of: weather", "weather: day.csv, stamp: end");
  const auto series = series_of(study);
  ASSERT_EQ(series.intervals.size(), 24u);
  const SkyGrid grid;
  const IntervalLights lights(study, Site{}, grid);
  std::size_t dark = 0;
  for (const auto& interval : series.intervals) {
    const IntervalLight light = lights.of(interval, 0);
    EXPECT_FALSE(light.is_dark());
    double horizontal = 0;
    for (std::size_t c = 0; c < light.sky.size(); ++c) {
      EXPECT_TRUE(std::isfinite(light.sky[c]) && light.sky[c] >= 0);
      horizontal += light.sky[c] * grid.projected()[c];
    }
    EXPECT_NEAR(horizontal, 40, 1e-9);
    if (interval.when.sunlit_s > 0) continue;
    ++dark;
    EXPECT_EQ(light.dni, 0);
    EXPECT_FALSE(light.has_sun());
  }
  EXPECT_EQ(dark, 6u);  // the whole hours between sunset at 20:14 and sunrise at 03:53
}

TEST(WeatherLight, TypicalYearsServeForTheDatesOfThePeriod) {
  write_text("typical.epw", test::small_epw());
  const auto own = series_of(weather_study("", "year_of: weather", "weather: typical.epw"));
  const auto day =
      series_of(weather_study("latitude_deg: 48.13, longitude_deg: 11.7, elevation_m: 529, "
                              "timezone: Europe/Berlin",
                              "days: [2028-06-21]", "weather: typical.epw"));
  ASSERT_EQ(day.intervals.size(), 24u);
  EXPECT_EQ(iso_utc(day.intervals.front().when.begin), "2028-06-20T22:00:00Z");
  // 00:00 of summer time is 23:00 of 20 June in standard time: the 24th hour of the 171st day.
  for (std::size_t i = 0; i < 24; ++i) {
    EXPECT_EQ(day.intervals[i].mean.dhi, own.intervals[170 * 24 + 23 + i].mean.dhi) << i;
    EXPECT_NEAR(day.intervals[i].mean.dni, own.intervals[170 * 24 + 23 + i].mean.dni, 1e-9) << i;
  }
  EXPECT_TRUE(tells(day.weather, "taken for the dates of the period"));
  const auto leap =
      refused(weather_study("timezone: UTC", "days: [2028-02-29]", "weather: typical.epw"));
  EXPECT_NE(leap.find("the weather does not cover"), std::string::npos) << leap;
  const auto across = series_of(
      weather_study("timezone: UTC", "start: 2026-12-31, end: 2027-01-02", "weather: typical.epw"));
  EXPECT_EQ(across.intervals.size(), 48u);
}

TEST(WeatherLight, ActualYearsKeepTheirDates) {
  SUNLOAD_NEEDS_MODEL(weather_folder + "zurich_sma_2016_leap.epw");
  const std::string zurich = shared("zurich_sma_2016_leap.epw");
  const auto missing = refused(weather_study("", "year_of: weather", zurich));
  EXPECT_NE(missing.find("epw:7201: DNI and DHI are missing here (120 of 8784 records"),
            std::string::npos)
      << missing;
  const auto leap_day = series_of(weather_study("timezone: UTC", "days: [2016-02-29]", zurich));
  EXPECT_EQ(leap_day.intervals.size(), 24u);
  EXPECT_NE(refused(weather_study("timezone: UTC", "days: [2026-06-21]", zurich))
                .find("does not cover 2026-06-21T00:00:00Z"),
            std::string::npos);
  for (const char* how : {"interpolate", "zero"}) {
    const auto filled =
        series_of(weather_study("", "year_of: weather", zurich + ", missing: " + how));
    EXPECT_EQ(filled.intervals.size(), 8784u);
    EXPECT_TRUE(tells(filled.notes,
                      "120 of 8784 records lack a value: DNI 120, DHI 120; the longest gap has "
                      "120 h"));
    double light = 0;
    for (std::size_t i = 7200; i < 7312; ++i) light += filled.intervals[i].mean.dhi;
    EXPECT_EQ(light > 0, std::string(how) == "interpolate");
  }
  EXPECT_NE(
      refused(weather_study("", "year_of: weather, as_year: 2001", zurich + ", missing: zero"))
          .find("2001 has no 29 February"),
      std::string::npos);
  EXPECT_EQ(iso_utc(series_of(weather_study("", "year_of: weather, as_year: 2004",
                                            zurich + ", missing: zero"))
                        .intervals.back()
                        .when.end),
            "2004-12-31T23:00:00Z");
}

/// Hours of consecutive days in June, but for the hours that begin in [from, to) of the first day.
std::string csv_with_hole(int days, int from, int to) {
  std::string text = roof + "time,dni_w_m2,dhi_w_m2\n";
  for (int h = 0; h < 24 * days; ++h)
    if (h < from || h >= to)
      text += fmt::format("2026-06-{:02}T{:02}:00,{},40\n", 20 + h / 24, h % 24, 100 + h % 24);
  return text;
}

TEST(WeatherLight, RowsThatAreMissingWithinADayAreMissingValues) {
  write_text("hole.csv", csv_with_hole(3, 9, 11));
  const auto with = [](const std::string& period, const std::string& missing) {
    return weather_study("timezone: UTC", period, "weather: hole.csv, stamp: start" + missing);
  };
  for (const char* period :
       {"year_of: weather", "days: [2026-06-20], from: '08:00', to: '12:00'"}) {
    const auto message = refused(with(period, ""));
    // Five lines of head, nine rows before the hole.
    EXPECT_NE(message.find("hole.csv:16: rows are missing before this one (2 of 60 min with sun "
                           "between 2026-06-20 09:00 +01:00 and 2026-06-20 11:00 +01:00"),
              std::string::npos)
        << message;
    EXPECT_NE(message.find("light.missing"), std::string::npos) << message;
  }
  const auto zero = series_of(with("year_of: weather", ", missing: zero"));
  ASSERT_EQ(zero.intervals.size(), 72u);
  EXPECT_EQ(zero.intervals[9].mean.dni, 0);
  EXPECT_TRUE(
      tells(zero.notes,
            "2 of 72 records lack a value: DNI 2, DHI 2; the longest gap has 2 h; 0 is taken"));
  EXPECT_TRUE(tells(zero.notes, "2 of them have no row"));
  const auto filled = series_of(with("year_of: weather", ", missing: interpolate"));
  ASSERT_EQ(filled.intervals.size(), 72u);
  EXPECT_NEAR(filled.intervals[9].mean.dni, 109, 1e-9);
  // Those who do not ask for these hours need not know.
  EXPECT_EQ(refused(with("days: [2026-06-21]", "")), "");
}

/// Two days in June with light from 4 to 20 o'clock, whose sun rises at 03:53 and sets at 20:14,
/// but for values of the hours that begin in [from, to) of the first.
std::string csv_with_gap(int from, int to) {
  std::string text = roof + "time,dni_w_m2,dhi_w_m2\n";
  for (int h = 0; h < 48; ++h) {
    const char* values = h % 24 >= 4 && h % 24 < 20 ? "400,90" : "0,0";
    text += fmt::format("2026-06-{:02}T{:02}:00,{}\n", 20 + h / 24, h % 24,
                        h >= from && h < to ? "," : values);
  }
  return text;
}

TEST(WeatherLight, GapsAtNightAreDark) {
  const auto light_of = [](int from, int to, const std::string& missing) {
    write_text("night.csv", csv_with_gap(from, to));
    return series_of(weather_study("timezone: UTC", "year_of: weather",
                                   "weather: night.csv, stamp: start" + missing));
  };
  const auto evening = light_of(19, 22, ", missing: interpolate");  // across sunset
  EXPECT_TRUE(tells(evening.notes, "3 of 48 records lack a value"));
  double by_day = 0;
  for (const auto& interval : evening.intervals) {
    EXPECT_TRUE(interval.when.up_s > 0 || interval.mean.dhi == 0);
    by_day += interval.mean.dhi;
  }
  // What lies in the light has something of the hour before.
  EXPECT_GT(by_day, 31 * 90);
  EXPECT_LT(by_day, 33 * 90);
  // Loggers may write nothing in the dark.
  const auto night = light_of(23, 27, "");
  EXPECT_TRUE(night.notes.empty());
  EXPECT_EQ(night.intervals.size(), 48u);
}

TEST(WeatherLight, ValuesThatAreMissingBetweenTheDaysOfThePeriodAreNoOnes) {
  std::string text = roof + "time,dni_w_m2,dhi_w_m2\n";
  for (int h = 0; h < 96; ++h)
    text +=
        fmt::format("2026-06-{:02}T{:02}:00,{},40\n", 20 + h / 24, h % 24, h == 36 ? "" : "100");
  write_text("gap.csv", text);
  const auto of = [](const char* days) {
    return weather_study("timezone: UTC", std::string("days: ") + days,
                         "weather: gap.csv, stamp: start");
  };
  const auto around = series_of(of("[2026-06-20, 2026-06-22]"));
  ASSERT_EQ(around.intervals.size(), 48u);
  EXPECT_EQ(around.intervals[36].mean.dni, 100);
  EXPECT_FALSE(tells(around.notes, "lack a value"));
  EXPECT_NE(refused(of("[2026-06-20, 2026-06-21]")).find("(1 of 48 records"), std::string::npos);
}

/// Three days of hours. Hours in [from, to) have `other` values, all others `values`: DNI, DHI,
/// GHI.
std::string csv_of_two(const std::string& values, const std::string& other, int from, int to) {
  std::string text = roof + "time,dni_w_m2,dhi_w_m2,ghi_w_m2\n";
  for (int h = 0; h < 72; ++h)
    text += fmt::format("2026-06-{:02}T{:02}:00,{}\n", 20 + h / 24, h % 24,
                        h >= from && h < to ? other : values);
  return text;
}

LightSeries series_of_two(const std::string& values, const std::string& other, int from, int to,
                          const std::string& missing = "") {
  write_text("two.csv", csv_of_two(values, other, from, to));
  return series_of(weather_study("timezone: UTC", "year_of: weather",
                                 "weather: two.csv, stamp: start" + missing));
}

bool is_same(const Irradiance& a, const Irradiance& b) {
  return a.dni == b.dni && a.dhi == b.dhi && a.ghi == b.ghi;
}

/// As a file does that lacks the column throughout, whatever `missing` says.
TEST(WeatherLight, RecordsThatHaveTwoOfThreeQuantitiesLackNothing) {
  for (const auto& [values, words] : std::vector<std::pair<std::string, std::string>>{
           {",80,300", "71 of 72 records have no DNI: it is (GHI - DHI) / sin(elevation)"},
           {"250,,300", "71 of 72 records have no DHI: it is GHI - DNI sin(elevation)"},
           {",,300", "71 of 72 records have GHI alone: GHI divided into DNI and DHI after Erbs"}}) {
    const auto whole = series_of_two(values, values, 0, 0);
    EXPECT_FALSE(tells(whole.notes, "of 72 records"));
    for (const char* missing : {"", ", missing: interpolate", ", missing: zero"}) {
      const auto mixed = series_of_two(values, "200,90,260", 12, 13, missing);
      ASSERT_EQ(mixed.intervals.size(), 72u);
      for (std::size_t i = 0; i < 72; ++i)
        EXPECT_EQ(is_same(mixed.intervals[i].mean, whole.intervals[i].mean), i != 12) << i;
      EXPECT_EQ(mixed.intervals[12].mean.dni, 200);
      EXPECT_TRUE(tells(mixed.notes, words)) << values;
      EXPECT_FALSE(tells(mixed.notes, "lack a value"));
    }
  }
}

/// Neighbours are completed before others are filled from them.
TEST(WeatherLight, WhatIsLeftIsFilledFromCompletedRecords) {
  write_text("two.csv", [] {
    std::string text = csv_of_two(",40,90", "50,40,90", 0, 1);
    const std::string row = "2026-06-21T11:00,";
    text.replace(text.find(row), row.size() + 6, row + ",40,");
    return text;
  }());
  const auto study = [](const std::string& missing) {
    return weather_study("timezone: UTC", "days: [2026-06-21]",
                         "weather: two.csv, stamp: start" + missing);
  };
  const auto light = series_of(study(", missing: interpolate"));
  // The period lacks DNI throughout: GHI is what is filled.
  EXPECT_TRUE(tells(light.notes, "1 of 24 records lack a value: GHI 1; the longest gap has 1 h"));
  EXPECT_NEAR(light.intervals[10].mean.ghi, 90, 1e-9);
  const std::string why = refused(study(""));
  EXPECT_NE(why.find("GHI is missing here (1 of 24 records"), std::string::npos) << why;
}

TEST(WeatherLight, OffsetsOfInstrumentsAreZero) {
  const auto light = series_of_two("300,80,", "-6.5,80,", 12, 14);
  EXPECT_EQ(light.intervals[12].mean.dni, 0);
  EXPECT_TRUE(tells(light.notes,
                    "2 values from -15 up to 0 W/m2 are taken as 0, as offsets of instruments: the "
                    "lowest is -6.5 W/m2, the first "));
  EXPECT_TRUE(tells(light.notes, "two.csv:19 (dni: -6.5 W/m2)"));
  EXPECT_FALSE(tells(series_of_two("300,80,", "0,80,", 12, 14).notes, "up to 0 W/m2"));
}

TEST(WeatherLight, ValuesThatNoOffsetReachesAreShown) {
  for (const auto& [values, shown] :
       {std::pair("-16,80,", "dni: -16 W/m2 is too low for an irradiance"),
        std::pair("300,-500,", "dhi: -500 W/m2 is too low for an irradiance")}) {
    const std::string why = test::refusal_of([&] { series_of_two("300,80,", values, 12, 14); });
    EXPECT_NE(why.find(std::string("two.csv:19: ") + shown), std::string::npos) << why;
    EXPECT_NE(why.find("lower values in the file: 2"), std::string::npos) << why;
    EXPECT_NE(why.find("light.missing: interpolate or zero"), std::string::npos) << why;
    EXPECT_EQ(why.find("missing here"), std::string::npos) << why;
  }
  const auto filled = series_of_two("300,80,", "-16,80,", 12, 14, ", missing: interpolate");
  EXPECT_NEAR(filled.intervals[12].mean.dni, 300, 1e-9);
  EXPECT_TRUE(tells(filled.notes,
                    "2 values below -15 W/m2, which offsets of instruments do not reach, are taken "
                    "as missing: the lowest is -16 W/m2, the first "));
  EXPECT_TRUE(tells(filled.notes, "two.csv:19 (dni: -16 W/m2)"));
}

/// One value of another day makes no column.
TEST(WeatherLight, SourceIsThatOfTheRecordsOfThePeriod) {
  write_text("two.csv", csv_of_two(",80,300", "200,90,260", 60, 61));
  const auto light = series_of(
      weather_study("timezone: UTC", "days: [2026-06-21]", "weather: two.csv, stamp: start"));
  EXPECT_TRUE(tells(light.weather, "DHI as it is, DNI = (GHI - DHI) / sin(elevation)"));
  EXPECT_FALSE(tells(light.notes, "of 24 records"));
  // Where it has nothing, other days tell what is filled.
  write_text("two.csv", csv_of_two("200,90,", ",,", 20, 50));
  const auto filled =
      series_of(weather_study("timezone: UTC", "days: [2026-06-21]",
                              "weather: two.csv, stamp: start, missing: interpolate"));
  EXPECT_NEAR(filled.intervals[12].mean.dni, 200, 1e-9);
}

/// As in files that are filtered by irradiance: the sun of 21 June rises at 03:53 and sets at
/// 20:14.
TEST(WeatherLight, RowsOfTheDarkMayBeMissing) {
  write_text("dark.csv", csv_with_hole(2, 21, 27));
  const auto series = series_of(
      weather_study("timezone: UTC", "year_of: weather", "weather: dark.csv, stamp: start"));
  EXPECT_EQ(series.intervals.size(), 42u);
  EXPECT_FALSE(tells(series.notes, "rows"));
}

/// Whole days may be asked for, too.
TEST(WeatherLight, OfDaysWhoseDarkHasNoRowsTheDarkIsDark) {
  write_text("dark.csv", csv_with_hole(2, 21, 27));
  const auto series = series_of(weather_study("timezone: UTC", "start: 2026-06-20, end: 2026-06-21",
                                              "weather: dark.csv, stamp: start"));
  ASSERT_EQ(series.intervals.size(), 24u);
  EXPECT_GT(series.intervals[18].mean.dni, 0);
  for (std::size_t hour = 20; hour < 24; ++hour) EXPECT_EQ(series.intervals[hour].mean.dhi, 0);
  EXPECT_TRUE(tells(series.weather, "intervals in the dark have no rows"));
  // The twin: in the morning the sun is up.
  write_text("morning.csv", csv_with_hole(2, 0, 8));
  EXPECT_NE(refused(weather_study("timezone: UTC", "days: [2026-06-20]",
                                  "weather: morning.csv, stamp: start"))
                .find("does not cover"),
            std::string::npos);
}

/// What is left out must be dark, at sunrise or at sunset: not the noon of a short day between two
/// long rows, nor minutes that a clock jumped over, nor an afternoon to midnight.
TEST(WeatherLight, DaylightThatHasNoRowIsNotTakenForDark) {
  const auto rows = [](const std::string& month, int step_h, int from, int to) {
    std::string text = roof + "time,dni_w_m2,dhi_w_m2\n";
    for (int h = 0; h < 72; h += step_h)
      if (h < from || h >= to)
        text += fmt::format("2026-{}-{:02}T{:02}:00,100,40\n", month, 20 + h / 24, h % 24);
    return text;
  };
  const auto of = [](const std::string& name, const std::string& text, const std::string& days) {
    write_text(name, text);
    return weather_study("timezone: '+01:00'", "days: [" + days + "]",
                         "weather: " + name + ", stamp: start");
  };
  EXPECT_NE(refused(of("long.csv", rows("12", 6, 30, 42), "2026-12-21")), "");
  EXPECT_NE(refused(of("short_day.csv", rows("12", 12, 24, 36), "2026-12-21")), "");
  EXPECT_NE(refused(of("afternoon.csv", rows("06", 1, 38, 48), "2026-06-21")).find("light.missing"),
            std::string::npos);
  EXPECT_NE(refused(of("morning.csv", rows("06", 1, 24, 35), "2026-06-21")).find("light.missing"),
            std::string::npos);
  std::string jumped = roof + "time,dni_w_m2,dhi_w_m2\n";
  for (int h = 0; h < 24; ++h)
    jumped += fmt::format("2026-06-21T{:02}:{},100,40\n", h, h < 12 ? "00" : "25");
  jumped += "2026-06-22T00:25,100,40\n";
  EXPECT_NE(refused(of("jumped.csv", jumped, "2026-06-21")).find("does not cover"),
            std::string::npos);
}

/// Stamps in UTC: midnight there is ten in the morning in Sydney.
TEST(WeatherLight, DaysOfAStationAreThoseOfItsSun) {
  const std::string text =
      "# latitude_deg: -33.9\n# longitude_deg: 151.2\n# elevation_m: 20\n# utc_offset: +00:00\n"
      "time,dni_w_m2,dhi_w_m2\n" +
      test::hours_without_midnight(12, 72);
  write_text("sydney.csv", text);
  const auto with = [](const std::string& missing) {
    return weather_study("timezone: Australia/Sydney", "year_of: weather",
                         "weather: sydney.csv, stamp: start" + missing);
  };
  EXPECT_NE(refused(with("")).find("rows are missing before this one"), std::string::npos);
  EXPECT_EQ(series_of(with(", missing: interpolate")).intervals.size(), 72u);
}

/// Rows of the last hour of February have stamps of 1 March, before which there is another day in
/// leap years.
TEST(WeatherLight, EndsOfFebruaryStayInItInOtherYears) {
  std::string text = roof + "time,dni_w_m2,dhi_w_m2\n";
  for (int h = 1; h <= 48; ++h)
    text += fmt::format("2027-{:02}-{:02}T{:02}:00,{},40\n", h < 24 ? 2 : 3,
                        h < 24 ? 28 : 1 + (h - 24) / 24, h % 24, h);
  write_text("march.csv", text);
  const auto series = series_of(weather_study(
      "timezone: '+01:00'", "year_of: weather, as_year: 2028", "weather: march.csv, stamp: end"));
  ASSERT_EQ(series.intervals.size(), 48u);
  EXPECT_EQ(iso_utc(series.intervals[23].when.begin), "2028-02-28T22:00:00Z");
  EXPECT_EQ(iso_utc(series.intervals[24].when.begin), "2028-02-29T23:00:00Z");
}

/// Turkey keeps summer time since 2016.
TEST(WeatherLight, ZonesThatChangeTheirStandardTimeNeedAnOffset) {
  for (const auto& [year, expected] : {std::pair{2015, false}, {2016, true}}) {
    std::string text = "time,dni_w_m2,dhi_w_m2\n";
    for (const auto& date : {fmt::format("{}-12-31", year), fmt::format("{}-01-01", year + 1)})
      for (int h = 0; h < 24; ++h) text += fmt::format("{}T{:02}:00,100,40\n", date, h);
    write_text("turkey.csv", text);
    const auto message =
        refused(weather_study("latitude_deg: 41, longitude_deg: 29, timezone: Europe/Istanbul",
                              "year_of: weather", "weather: turkey.csv, stamp: start"));
    EXPECT_EQ(
        message.find("standard time of Europe/Istanbul was UTC+02:00 in 2016") != std::string::npos,
        expected)
        << year << " " << message;
  }
}

TEST(WeatherLight, WholeDaysThatAreMissingAreToldInAWarning) {
  write_text("campaigns.csv", csv_with_hole(5, 14, 24 * 3 + 8));
  const auto series = series_of(
      weather_study("timezone: UTC", "year_of: weather", "weather: campaigns.csv, stamp: start"));
  EXPECT_EQ(series.intervals.size(), 24u * 5 - (24 * 3 + 8 - 14));
  EXPECT_TRUE(tells(series.notes,
                    "2 whole days have no rows, from 2026-06-20 14:00 +01:00 to 2026-06-23 08:00 "
                    "+01:00 (line 21); they are no part of the period"));
}

/// Ten days of June in one year and in the next.
TEST(WeatherLight, CampaignsOfYearsServeForTheirDatesOnly) {
  for (const int month : {6, 7}) {
    std::string text = roof + "time,dni_w_m2,dhi_w_m2\n";
    for (int h = 0; h < 480; ++h)
      text += fmt::format("{}-{:02}-{:02}T{:02}:00,{},40\n", h < 240 ? 2022 : 2023,
                          h < 240 ? 6 : month, 1 + h % 240 / 24, h % 24, h < 240 ? 100 : 300);
    write_text("campaigns.csv", text);
    const auto of = [](const std::string& date) {
      return weather_study("timezone: '+01:00'", "days: [" + date + "]",
                           "weather: campaigns.csv, stamp: start");
    };
    EXPECT_EQ(series_of(of("2022-06-05")).intervals[12].mean.dni, 100);
    const auto later = series_of(of(fmt::format("2023-{:02}-05", month)));
    EXPECT_EQ(later.intervals[12].mean.dni, 300);
    EXPECT_TRUE(tells(later.weather, "years 2022 to 2023"));
    for (const char* date : {"2022-08-05", "2023-05-05", "2031-06-05", "2022-06-11"}) {
      const auto why = refused(of(date));
      EXPECT_NE(why.find("the weather does not cover"), std::string::npos) << date << why;
    }
    const auto own = series_of(weather_study("timezone: '+01:00'", "year_of: weather",
                                             "weather: campaigns.csv, stamp: start"));
    EXPECT_EQ(iso_utc(own.intervals.back().when.end),
              fmt::format("2023-{:02}-10T23:00:00Z", month));
    EXPECT_TRUE(tells(own.notes, "whole days have no rows, from 2022-06-11 00:00"));
  }
}

/// Light of a day of hours on level ground [Wh m-2].
double horizontal_wh(const LightSeries& series) {
  double sum = 0;
  for (const auto& i : series.intervals)
    sum += i.mean.dni * std::max(0.0, std::sin(radians(i.when.sun.elevation_deg))) + i.mean.dhi;
  return sum;
}

LightSeries series_of_day(const std::string& columns, const std::string& values) {
  write_text("day.csv", csv_day("2026-06-21", values, columns, roof));
  return series_of(weather_study("", "year_of: weather", "weather: day.csv, stamp: end"));
}

TEST(WeatherLight, QuantitiesThatContradictEachOtherAreToldWithTheirAmount) {
  const auto beam = series_of_day("ghi,dhi", "700,50");
  EXPECT_NEAR(horizontal_wh(beam), 24 * 700, 1e-6);
  EXPECT_TRUE(tells(beam.notes, "records have GHI - DHI above the sun's own beam outside of the"));
  EXPECT_TRUE(tells(beam.notes, "are stamp and time zone of the weather right?"));
  const auto diffuse = series_of_day("ghi,dhi", "50,100");
  EXPECT_NEAR(horizontal_wh(diffuse), 24 * 100, 1e-6);
  EXPECT_TRUE(tells(diffuse.notes,
                    "24 records have DHI above GHI: 1200 Wh/m2 (100 % of GHI) more light than GHI "
                    "has, DHI is kept; are the columns of the weather right?"));
  const auto direct = series_of_day("ghi,dni", "50,500");
  const auto share = fmt::format("{:.4g} Wh/m2", horizontal_wh(direct) - 24 * 50);
  EXPECT_TRUE(tells(direct.notes, "records have DNI sin(elevation) above GHI: " + share)) << share;
  // What is little is a note.
  const auto little = series_of_day("ghi,dhi", "200,200.1");
  EXPECT_TRUE(little.notes.empty());
  EXPECT_TRUE(tells(little.weather, "24 records have DHI above GHI: 2.4 Wh/m2 (0.05 % of GHI)"));
}

TEST(WeatherLight, SunAndSkyThatBringLessThanTheGroundGetsAreWarnedOf) {
  const auto day = [](const std::string& in_the_morning, const std::string& after) {
    std::string text = roof + "time,ghi,dni,dhi\n";
    for (int hour = 1; hour <= 24; ++hour)
      text += fmt::format("2026-06-21T{:02}:00,{}\n", hour, hour <= 12 ? in_the_morning : after);
    write_text("day.csv", text);
    return weather_study("", "year_of: weather", "weather: day.csv, stamp: end");
  };
  EXPECT_TRUE(tells(series_of(day("100,0,0", "100,0,100")).notes,
                    " % less than GHI over 18 sunlit records"));
  EXPECT_TRUE(series_of(day("100,0,95", "100,0,95")).notes.empty());
  EXPECT_TRUE(series_of(day("100,0,105", "100,0,105")).notes.empty());
  // What instruments are off by is a large share of little.
  EXPECT_TRUE(series_of(day("4,0,0", "4,0,2")).notes.empty());
  const auto none = refused(day("100,0,0", "100,0,0"));
  EXPECT_NE(none.find("day.csv: DNI and DHI are 0 in all of 18 sunlit records, where GHI is 100 "
                      "W/m2 in the mean (light is made from DNI and DHI: there would be none)"),
            none.npos)
      << none;
  EXPECT_NE(none.find("light.decomposition divides GHI"), none.npos) << none;
}

TEST(WeatherLight, HoursWithoutAnyLightBelowAHighSunAreWarnedOf) {
  const auto series = series_of_day("dni,dhi", "0,0");
  EXPECT_TRUE(tells(series.notes, "records have no light at all with the sun above 10 degrees"));
  EXPECT_FALSE(tells(series_of_day("dni,dhi", "0,1").notes, "no light at all"));
}

TEST(WeatherLight, KilowattsAreWarnedOf) {
  EXPECT_TRUE(tells(series_of_day("dni,dhi", "0.8,0.1").notes,
                    "records with the sun above 10 degrees exceeds 0.8 W/m2; they are taken as "
                    "they are: are they in kW/m2?"));
  EXPECT_FALSE(tells(series_of_day("dni,dhi", "0,4").notes, "kW/m2"));
}

// As of stamps or a time zone that are off by hours.
TEST(WeatherLight, MuchDirectLightInTheDarkIsWarnedOf) {
  const auto shifted = series_of_day("dni,dhi", "500,40");
  EXPECT_TRUE(tells(shifted.notes, "records have DNI without sun above the horizon: "));
  EXPECT_TRUE(
      tells(shifted.notes, " % of all DNI); are stamp and time zone of the weather right?"));
  std::string text = roof + "time,dni,dhi\n";
  for (int hour = 1; hour <= 24; ++hour)
    text += fmt::format("2026-06-21T{:02}:00,{},40\n", hour, hour > 6 && hour < 19 ? 500 : 2);
  write_text("night.csv", text);
  const auto offset =
      series_of(weather_study("", "year_of: weather", "weather: night.csv, stamp: end"));
  EXPECT_TRUE(offset.notes.empty());
  EXPECT_TRUE(tells(offset.weather, "records have DNI without sun above the horizon: "));
}

TEST(WeatherLight, DniAboveTheSunsOwnIsWarnedOf) {
  const auto series = series_of_day("dni,dhi", "1500,40");
  EXPECT_EQ(series.intervals[12].mean.dni, 1500);
  // Five lines of head, one of names, four rows of the dark.
  EXPECT_TRUE(
      tells(series.notes, "records have DNI above the sun's own outside of the atmosphere"));
  EXPECT_TRUE(tells(series.notes, "day.csv:10 with 1500 of at most 131"));
  EXPECT_FALSE(tells(series_of_day("dni,dhi", "1300,40").notes, "the sun's own"));
}

/// As of stations that nobody reads in the evening.
TEST(WeatherLight, HoursThatNobodyMeasuresAreToldInAWarning) {
  write_text("daytime.csv", csv_with_hole(2, 17, 24 + 9));
  const auto series = series_of(
      weather_study("timezone: UTC", "year_of: weather", "weather: daytime.csv, stamp: start"));
  EXPECT_EQ(series.intervals.size(), 48u - 16);
  EXPECT_TRUE(tells(series.notes,
                    "hours with sun before or after midnight have no rows, from "
                    "2026-06-20 17:00 +01:00 to 2026-06-21 09:00 +01:00"));
}

TEST(WeatherLight, FilteredYearsLackNothing) {
  SUNLOAD_NEEDS_MODEL(weather_folder + "chicago_filtered.wea");
  const auto series =
      series_of(weather_study("", "year_of: weather", shared("chicago_filtered.wea")));
  EXPECT_EQ(series.intervals.size(), 4427u);
}

TEST(WeatherLight, GlobalIrradianceNamesItsDecomposition) {
  const auto file = write_text("day.csv", csv_day("2026-06-21", "400", "ghi_w_m2", roof));
  const auto erbs =
      series_of(weather_study("", "year_of: weather", "weather: day.csv, stamp: end"));
  const auto disc = series_of(
      weather_study("", "year_of: weather", "weather: day.csv, stamp: end, decomposition: disc"));
  EXPECT_TRUE(tells(erbs.weather, "after Erbs, Klein & Duffie (1982)"));
  EXPECT_TRUE(tells(disc.weather, "by DISC, Maxwell (1987)"));
  EXPECT_GT(erbs.intervals[12].mean.dni, 0);
  EXPECT_NE(erbs.intervals[12].mean.dni, disc.intervals[12].mean.dni);
  EXPECT_EQ(erbs.intervals[12].mean.ghi, 400);
}

TEST(WeatherLight, TimesOfACsvWithoutZoneAreStandardTimeOfTheSite) {
  write_text("day.csv", csv_day("2026-06-21", "100,40", "dni,dhi", ""));
  const auto series =
      series_of(weather_study("latitude_deg: 50, longitude_deg: 14, timezone: Europe/Prague",
                              "year_of: weather", "weather: day.csv, stamp: end"));
  EXPECT_EQ(iso_utc(series.intervals.front().when.begin), "2026-06-20T23:00:00Z");
  EXPECT_TRUE(tells(series.weather, "from site.timezone"));
}

TEST(WeatherLight, FarStationsAreWarnedAbout) {
  write_text("typical.epw", test::small_epw());
  const auto far = series_of(weather_study("latitude_deg: 59.33, longitude_deg: 18.07",
                                           "year_of: weather", "weather: typical.epw"));
  EXPECT_TRUE(tells(far.notes, "km from the site"));
  EXPECT_TRUE(
      series_of(weather_study("", "year_of: weather", "weather: typical.epw")).notes.empty());
}

TEST(WeatherLight, ShiftedStampsAreWarnedAbout) {
  SUNLOAD_NEEDS_MODEL(weather_folder + "gothenburg_tmyx.epw");
  // Its radiation belongs to the sun at the end of the hours (reanalysis at full hours).
  const auto near = series_of(weather_study("", "year_of: weather", shared("gothenburg_tmyx.epw")));
  ASSERT_EQ(near.notes.size(), 1u);
  EXPECT_TRUE(tells(near.notes, "the sun 30 min later fits")) << near.notes[0];
}

TEST(WeatherLight, HashKnowsTheBytesAndTheRulesOfTheFile) {
  const auto hash = [](const std::string& values, const std::string& rules) {
    write_text("day.csv", csv_day("2026-06-21", values, "dni,dhi", roof));
    return make_plan(weather_study("", "year_of: weather", "weather: day.csv, stamp: end" + rules))
        .content_hash;
  };
  const auto base = hash("100,40", "");
  EXPECT_EQ(hash("100,40", ""), base);
  EXPECT_NE(hash("100,41", ""), base);
  EXPECT_NE(hash("100,40", ", missing: zero"), base);
  EXPECT_NE(hash("100,40", ", decomposition: disc"), base);
}

TEST(WeatherLight, VariantsHaveTheTimesOfTheirFiles) {
  write_text("flat.obj", "v 0 0 0\nv 10 0 0\nv 0 10 0\nf 1 2 3\n");
  write_text("a.csv", csv_day("2026-06-21", "100,40", "dni,dhi", roof));
  write_text("b.csv", csv_day("2026-06-22", "100,40", "dni,dhi", roof));
  const StudyFile file = read_study(write_text(
      "w.yaml",
      "format: sunload-study-1\nname: w\nperiod: {year_of: weather}\n"
      "light: {source: weather, weather: a.csv, stamp: end}\nscene: {files: [flat.obj]}\n"
      "variants: [{name: one}, {name: two, light: {weather: b.csv}}]\n"));
  Planner planner;
  const auto begin = [&](std::size_t variant) {
    return planner.plan(file.variants[variant]).light.intervals.front().when.begin;
  };
  const UnixTime first = begin(0);
  EXPECT_EQ(begin(1) - first, 86400);
}

// 12 Linke values are mid-month, linear between: the middle of June has June's value.
TEST(ClearSky, MonthlyTurbidityIsThatOfTheMonthsMiddle) {
  const auto mean = [](const std::string& turbidity) {
    write_text("flat.obj", "v 0 0 0\nv 10 0 0\nv 0 10 0\nf 1 2 3\n");
    const auto study = read_study(
        write_text("c.yaml",
                   "format: sunload-study-1\nname: c\nsite: {latitude_deg: 50, longitude_deg: 14, "
                   "timezone: UTC}\nperiod: {instants: [2026-06-16T00:00, 2026-07-01T06:00, "
                   "2026-07-16T12:00], interval_min: 10}\nlight: {linke_turbidity: " +
                       turbidity + "}\nscene: {files: [flat.obj]}\n"));
    std::vector<double> dni;
    for (const auto& i : series_of(study.variants.front()).intervals) dni.push_back(i.mean.dni);
    return dni;
  };
  const auto monthly = mean("[2, 2, 2, 2, 2, 3, 5, 2, 2, 2, 2, 2]");
  EXPECT_EQ(monthly[2], mean("5")[2]);
  // Half way between the middles of June (16th, 0 h) and July (16th, 12 h).
  EXPECT_NEAR(monthly[1], mean("4")[1], 1e-9);
}

}  // namespace
}  // namespace sunload
