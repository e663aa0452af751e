// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Wrong clocks of weather files as users are told of them; real files, right and shifted.
#include "io/plan/clock_words.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "geo/base/units.h"
#include "io/plan/light_series.h"
#include "io/plan/scene_build.h"
#include "tests/support/real_models.h"
#include "tests/support/scene_text.h"
#include "tests/support/small_weather.h"

namespace sunload {
namespace {

using test::write_text;

LightSeries clock_series(const std::string& file, const std::string& text,
                         const std::string& light) {
  write_text("flat.obj", "v 0 0 0\nv 10 0 0\nv 0 10 0\nf 1 2 3\n");
  write_text(file, text);
  const Study study =
      read_study(
          write_text("clock.yaml", fmt::format("format: sunload-study-1\nname: w\n"
                                               "site: {{latitude_deg: 48.13, longitude_deg: 11.7, "
                                               "elevation_m: 529, timezone: Europe/Berlin}}\n"
                                               "period: {{year_of: weather}}\n"
                                               "light: {{source: weather, weather: {}{}}}\n"
                                               "scene: {{files: [flat.obj]}}\n",
                                               file, light)))
          .variants.front();
  return light_series(study, build_scene(study).site);
}

/// The one warning that has these words; empty where there is none.
std::string warning_with(const std::vector<std::string>& warnings, const std::string& words) {
  for (const auto& warning : warnings)
    if (warning.find(words) != warning.npos) return warning;
  return {};
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

const std::string of_sun = "than the sun of its stamps";

/// As `small_csv`, of what pyranometers measure.
std::string global_csv() {
  std::string text = "time,ghi_w_m2,dhi_w_m2\n";
  test::each_small_hour({}, [&](const test::SmallHour& h) {
    text += fmt::format("2026-{:02}-{:02}T{:02}:00,{},{}\n", h.month, h.day, h.hour, h.ghi, h.dhi);
  });
  return text;
}

TEST(WeatherClockWords, RightStampsAreSilent) {
  EXPECT_EQ(warning_with(clock_series("w.csv", test::small_csv(), ", stamp: end").notes, of_sun),
            "");
  EXPECT_EQ(warning_with(clock_series("w.csv", global_csv(), ", stamp: end").notes, of_sun), "");
  EXPECT_EQ(warning_with(clock_series("w.epw", test::small_epw(), "").notes, of_sun), "");
  EXPECT_EQ(warning_with(clock_series("w.wea", test::small_wea(), "").notes, of_sun), "");
}

TEST(WeatherClockWords, StampOrZoneThatWouldFitIsNamed) {
  const auto starts =
      warning_with(clock_series("w.csv", test::small_csv(), ", stamp: start").notes, of_sun);
  EXPECT_TRUE(has(starts, "59 min later")) << starts;
  EXPECT_TRUE(has(starts,
                  "light.stamp: end, or a line '# utc_offset: +02:00' above its columns "
                  "(site.timezone has UTC+01:00)"))
      << starts;
  const auto middles =
      warning_with(clock_series("w.csv", global_csv(), ", stamp: middle").notes, of_sun);
  EXPECT_TRUE(has(middles, "29 min later")) << middles;
  EXPECT_TRUE(has(middles, "light.stamp: end")) << middles;
  EXPECT_FALSE(has(middles, "utc_offset")) << middles;
  const auto utc = warning_with(
      clock_series("w.csv", "# utc_offset: +09:00\n" + test::small_csv(), ", stamp: end").notes,
      of_sun);
  EXPECT_TRUE(has(utc, "481 min earlier")) << utc;
  EXPECT_TRUE(has(utc, "UTC+01:00 in place of UTC+09:00 in '# utc_offset'")) << utc;
}

TEST(WeatherClockWords, ZonesOfHeadsAreNamed) {
  std::string epw = test::small_epw();
  epw.replace(epw.find(",11.7,1,"), 8, ",11.7,3,");
  const auto of_epw = warning_with(clock_series("w.epw", epw, "").notes, of_sun);
  EXPECT_TRUE(has(of_epw, "121 min earlier")) << of_epw;
  EXPECT_TRUE(has(of_epw, "UTC+01:00 in place of UTC+03:00 in LOCATION")) << of_epw;
  EXPECT_FALSE(has(of_epw, "light.stamp")) << of_epw;  // which EPW does not take
  std::string wea = test::small_wea();
  wea.replace(wea.find("time_zone -15"), 13, "time_zone 0");
  const auto of_wea = warning_with(clock_series("w.wea", wea, "").notes, of_sun);
  EXPECT_TRUE(has(of_wea, "UTC+01:00 in place of UTC+00:00 in time_zone")) << of_wea;
}

/// As a logger on civil time writes it; days without the equation of time, which is 15 min of it.
TEST(WeatherClockWords, SummerTimeIsTold) {
  std::string text = "time,dni_w_m2,dhi_w_m2\n";
  test::each_small_hour({}, [&](const test::SmallHour& h) {
    const bool is_advanced = h.month >= 4 && h.month <= 10;
    if (is_advanced && h.hour == 24) return;
    text += fmt::format("2026-{:02}-{:02}T{:02}:00,{},{}\n", h.month, h.day,
                        h.hour + (is_advanced ? 1 : 0), h.dni, h.dhi);
  });
  const auto notes = clock_series("w.csv", text, ", stamp: end").notes;
  const auto told = warning_with(notes, "daylight saving time");
  EXPECT_TRUE(has(told, "74 min later in summer")) << told;
  EXPECT_EQ(warning_with(notes, of_sun), "");
}

/// Files of five makers, as they are and with every stamp moved.
TEST(WeatherClockWords, RealFilesAreToldWhereTheyAreShifted) {
  constexpr double minute = seconds_per_minute;
  constexpr double telling_s = 35 * minute;
  for (const std::string name :
       {"WD100_denver.epw", "WD300_santiago.epw", "chicago_tmy3.epw", "munich_iwec.epw",
        "chicago_filtered.wea", "san_francisco_10min.wea", "best_field_15min.csv",
        "gothenburg_tmyx.epw", "zurich_sma_2016_leap.epw"}) {
    SUNLOAD_NEEDS_MODEL("data/weather/" + name);
    const WeatherFile file = read_weather_file(test::shared_path("data/weather/" + name), {});
    constexpr int leap_year = 2016;
    const auto as_written = dated(file.records, leap_year, *file.offset_s);
    const double margin_s = 3 * seconds_per_day;
    const SunEphemeris sun(
        as_written.front().begin - margin_s, as_written.back().end + margin_s,
        {.latitude_deg = file.place->latitude_deg, .longitude_deg = file.place->longitude_deg},
        Refraction::spa, Ut1::zero, standard_air(0));
    const auto shifted = [&](double late_s, double late_in_summer_s) {
      auto weather = as_written;
      for (auto& w : weather) {
        const int month = calendar_from_utc(w.begin).month;
        const bool is_north_summer = month >= 4 && month <= 10;
        const bool is_summer = is_north_summer == (file.place->latitude_deg > 0);
        w.begin += late_s + (is_summer ? late_in_summer_s : 0);
        w.end += late_s + (is_summer ? late_in_summer_s : 0);
      }
      return clock_of(weather, sun, file.place->latitude_deg, file.place->longitude_deg);
    };
    const WeatherClock right = shifted(0, 0);
    EXPECT_FALSE(right.all.exceeds(telling_s)) << name;
    EXPECT_FALSE(right.has_summer_time()) << name;
    // Of Gothenburg's the sun's light comes 29 min early, of Zurich's 21 min late.
    const double own_s = right.all.whole.median;
    for (const double late_min : {-480.0, -120.0, -60.0, -45.0, 45.0, 60.0, 120.0, 420.0}) {
      const WeatherClock clock = shifted(late_min * minute - own_s, 0);
      EXPECT_TRUE(clock.all.exceeds(telling_s)) << name << late_min;
      EXPECT_FALSE(clock.has_summer_time()) << name << late_min;
    }
    if (right.winter.days >= 10) {  // half a year has no winter to compare with
      EXPECT_TRUE(shifted(0, seconds_per_hour).has_summer_time()) << name;
    }
  }
}

}  // namespace
}  // namespace sunload
