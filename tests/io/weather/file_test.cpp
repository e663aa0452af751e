// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Readers of weather: formats, conventions, missing values, broken files.
#include "io/weather/file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <random>
#include <sstream>

#include "tests/support/real_models.h"
#include "tests/support/scene_text.h"
#include "tests/support/small_weather.h"

namespace sunload {
namespace {

using test::write_text;

const std::string folder = "data/weather/";

WeatherFile read_shared(const std::string& name, std::optional<Stamp> stamp = {}) {
  return read_weather_file(test::shared_path(folder + name), stamp);
}

WeatherFile read(const std::string& name, const std::string& text,
                 std::optional<Stamp> stamp = {}) {
  return read_weather_file(write_text(name, text), stamp);
}

/// What a file is refused with, from its name on; empty if it is read.
std::string refused(const std::string& name, const std::string& text,
                    std::optional<Stamp> stamp = {}) {
  const auto path = write_text(name, text);
  try {
    read_weather_file(path, stamp);
  } catch (const InputError& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.rfind(path, 0), 0u) << "the message begins with the file: " << what;
    return what.substr(what.find(name));
  }
  return {};
}

double ghi_kwh(const WeatherFile& file) {
  double sum = 0;
  for (const auto& r : file.records)
    sum += r.values.ghi.value_or(0) * (r.end_s - r.begin_s) / 3.6e6;
  return sum;
}

/// Facts of the folder's README.
struct Fact {
  const char* file;
  const char* place;
  double latitude_deg, longitude_deg, offset_h, elevation_m;
  std::size_t rows;
  double ghi_kwh_m2;  ///< 0: the format has none
  WeatherYears years;
  double step_min;
};

TEST(WeatherFiles, HaveTheFactsOfTheirReadme) {
  using enum WeatherYears;
  constexpr double missing = 120 * 0.999;  // the README adds up 120 hours of -999 W/m² in Zurich
  const Fact facts[] = {
      {"chicago_filtered.wea", "Chicago Ohare Intl Ap", 41.98, -87.92, -6, 201, 4427, 0, typical,
       60},
      {"chicago_tmy3.epw", "Chicago Ohare Intl Ap", 41.98, -87.92, -6, 201, 8760, 1407, typical,
       60},
      {"gothenburg_tmyx.epw", "Gothenburg-Landvetter.AP", 57.663, 12.28, 1, 155.2, 8760, 1040,
       typical, 60},
      {"munich_iwec.epw", "MUNICH", 48.13, 11.7, 1, 529, 8760, 1123, typical, 60},
      {"san_francisco_10min.wea", "San Francisco Intl Ap", 37.62, -122.4, -8, 2, 52560, 0, typical,
       10},
      {"WD100_denver.epw", "Denver Intl AP", 39.833, -104.65, -7, 1650, 8760, 1670, typical, 60},
      {"WD300_santiago.epw", "Santiago Benitez Intl AP", -33.393, -70.786, -4, 474, 8760, 1911,
       typical, 60},
      {"zurich_sma_2016_leap.epw", "Zuerich-SMA", 47.378, 8.567, 1, 556, 8784, 1029 + missing,
       actual, 60},
      {"best_field_15min.csv", "DENVER/CENTENNIAL [GOLDEN - NREL]", 39.742, -105.179, -7, 1829,
       5857, 0, actual, 15}};
  for (const auto& fact : facts) {
    SUNLOAD_NEEDS_MODEL(folder + fact.file);
    const WeatherFile file = read_shared(fact.file);
    ASSERT_TRUE(file.place) << fact.file;
    EXPECT_EQ(file.place->name, fact.place);
    EXPECT_EQ(file.place->latitude_deg, fact.latitude_deg);
    EXPECT_EQ(file.place->longitude_deg, fact.longitude_deg) << fact.file;
    EXPECT_EQ(*file.offset_s, fact.offset_h * 3600) << fact.file;
    EXPECT_EQ(file.place->elevation_m, fact.elevation_m);
    EXPECT_EQ(file.records.size(), fact.rows) << fact.file;
    EXPECT_EQ(years_of(file.records), fact.years) << fact.file;
    EXPECT_EQ(file.records[7].end_s - file.records[7].begin_s, fact.step_min * 60) << fact.file;
    // The README rounds to whole kWh.
    if (fact.ghi_kwh_m2 > 0) {
      EXPECT_NEAR(ghi_kwh(file), fact.ghi_kwh_m2, 0.5) << fact.file;
    }
  }
}

TEST(WeatherFiles, ThatAreNoneAreRefusedByReason) {
  // The path of the sun over a day, and a page.
  for (const char* text : {"time,azimuth,elevation\n2026-06-21 00:00,1.5,3.2\n",
                           "# Weather\n\nSix files, of six places.\n"}) {
    const auto message = refused("none.csv", text);
    EXPECT_NE(message.find("is no weather file that can be read"), std::string::npos) << message;
  }
}

TEST(WeatherFiles, OfPvgisAreSentToItsEpw) {
  for (const char* text :
       {"Latitude (decimal degrees): 45.812\nLongitude (decimal degrees): 8.628\nElevation (m): "
        "219.0\n"
        "month,year\n1,2011\n\ntime(UTC),T2m,RH,G(h),Gb(n),Gd(h)\n20110101:0000,0.9,80,0,0,0\n",
        "{\"inputs\": {\"location\": {\"latitude\": 45.8}}, \"meta\": {\"units\": \"decimal "
        "degree\"}}\n"}) {
    const auto message = refused("pvgis.csv", text);
    EXPECT_NE(message.find("is of PVGIS"), std::string::npos) << message;
    EXPECT_NE(message.find("EPW"), std::string::npos) << message;
  }
}

/// 0xfc is ü in Latin-1.
TEST(WeatherFiles, NamesOfStationsBecomeUtf8) {
  const std::string day = "time,dni_w_m2,dhi_w_m2\n2026-06-21T12:00,1,1\n2026-06-21T13:00,1,1\n";
  const std::string head = "# latitude_deg: 48\n# longitude_deg: 11\n# place: ";
  const auto latin = read("latin.csv", head + "M\xfcnchen\n" + day, Stamp::start);
  EXPECT_EQ(latin.place->name, "München");
  ASSERT_EQ(latin.notes.size(), 1u);
  EXPECT_NE(latin.notes[0].find("not in UTF-8, read as Windows-1252 (Latin-1): 'München'"),
            std::string::npos);
  const auto utf8 = read("utf8.csv", head + "München\n" + day, Stamp::start);
  EXPECT_EQ(utf8.place->name, "München");
  EXPECT_TRUE(utf8.notes.empty());
  EXPECT_EQ(read("red.csv", head + "M\x1b[31m\n" + day, Stamp::start).place->name, "M\\x1b[31m");
  const std::string wea =
      "place M\xfcnchen\nlatitude 48\nlongitude -11\ntime_zone -15\nsite_elevation 500\n"
      "weather_data_file_units 1\n6 21 11.5 1 1\n6 21 12.5 1 1\n";
  EXPECT_EQ(read("latin.wea", wea).place->name, "München");
}

/// Decimal hours of three digits, of the middles of steps: 2.5 and 0.5 minutes and so on.
TEST(WeatherFiles, WeaOfMinutesHasTheStepsOfItsMiddles) {
  for (const int minutes : {1, 5, 10, 15}) {
    std::string wea =
        "place a\nlatitude 48\nlongitude -11\ntime_zone -15\nsite_elevation 500\n"
        "weather_data_file_units 1\n";
    for (int k = 0; k < 60; ++k)
      wea += fmt::format("6 21 {:.3f} 1 1\n", 6 + (k + 0.5) * minutes / 60.0);
    const auto records = read("minutes.wea", wea).records;
    ASSERT_EQ(records.size(), 60u);
    for (const auto& r : records) EXPECT_NEAR(r.end_s - r.begin_s, 60. * minutes, 1e-9) << minutes;
  }
}

TEST(WeatherFiles, OneHourInEpwAndWeaIsTheSameStretch) {
  SUNLOAD_NEEDS_MODEL(folder + "chicago_tmy3.epw");
  const auto epw = dated(read_shared("chicago_tmy3.epw").records, 2001, 0);
  const auto wea = dated(read_shared("chicago_filtered.wea").records, 2001, 0);
  std::size_t at = 0;
  for (const auto& w : wea) {
    while (at < epw.size() && epw[at].begin < w.begin - 1) ++at;
    ASSERT_LT(at, epw.size());
    EXPECT_EQ(epw[at].begin, w.begin);
    EXPECT_EQ(epw[at].end, w.end);
    EXPECT_EQ(epw[at].values.dni, w.values.dni) << w.line;
    EXPECT_EQ(epw[at].values.dhi, w.values.dhi) << w.line;
  }
}

TEST(WeatherFiles, ZurichLacksFiveDaysAndHasItsLeapDay) {
  SUNLOAD_NEEDS_MODEL(folder + "zurich_sma_2016_leap.epw");
  const auto file = read_shared("zurich_sma_2016_leap.epw");
  const auto weather = dated(file.records, {}, *file.offset_s);
  const auto gaps = fill_missing(weather, source_of(weather), Missing::refuse);
  EXPECT_EQ(gaps.records, 120u);
  EXPECT_EQ(gaps.longest_gap_s, 120 * 3600.0);
  EXPECT_EQ(iso_utc(weather[59 * 24].begin), "2016-02-28T23:00:00Z");  // 29 February, 00:00 UTC+1
  EXPECT_EQ(iso_utc(weather.back().end), "2016-12-31T23:00:00Z");
  EXPECT_EQ(dated(file.records, 2001, 0).size(), 8760u);
}

// ---- EPW

std::string epw_header(const std::string& zone, int per_hour, const std::string& first,
                       const std::string& last) {
  return "LOCATION,\"Some, Place\",-,IND,Src,1,28.6,77.2," + zone + ",216\nDATA PERIODS,1," +
         std::to_string(per_hour) + ",Data,Sunday," + first + "," + last + "\n";
}

std::string epw_row(int year, int month, int day, int hour, int minute, const std::string& ghi,
                    const std::string& dni, const std::string& dhi) {
  return fmt::format("{},{},{},{},{},?9,20,10,50,101325,0,0,300,{},{},{},0,0,0\n", year, month, day,
                     hour, minute, ghi, dni, dhi);
}

std::string epw_days(int year, int days, int per_hour, int minute_of_first) {
  std::string text;
  for (int day = 1; day <= days; ++day)
    for (int hour = 1; hour <= 24; ++hour)
      for (int k = 0; k < per_hour; ++k)
        text += epw_row(year, 6, day, hour, minute_of_first + k * 60 / per_hour, "300", "400",
                        std::to_string(k));
  return text;
}

TEST(Epw, HourOneBeginsAtMidnightWhateverTheMinuteSays) {
  for (const int minute : {0, 30, 60}) {
    const auto file =
        read("a.epw", epw_header("5.5", 1, "6/1", "6/2") + epw_days(1999, 2, 1, minute));
    EXPECT_EQ(file.place->name, "Some, Place");
    EXPECT_EQ(*file.offset_s, 5.5 * 3600);
    ASSERT_EQ(file.records.size(), 48u);
    EXPECT_EQ(file.records.front().begin_s, 0);
    EXPECT_EQ(file.records[23].end_s, 86400);
    const auto weather = dated(file.records, {}, *file.offset_s);
    EXPECT_EQ(iso_utc(weather.front().begin), "1999-05-31T18:30:00Z");
  }
}

// Its rows are those of its CSV, hours of UTC; LOCATION may name another zone. A year of PVGIS 5.3
// (45 N, 8 E) then closes to 0.8 W/m2, and to 32 as its head has it.
TEST(Epw, OfPvgisHasTheHoursAboutItsMoments) {
  std::string head = epw_header("1", 1, "6/1", "6/2");
  head.insert(head.find("DATA PERIODS"), "COMMENTS 2,Irradiance Time Offset (h):-0.8239\n");
  const auto file = read("a.epw", head + epw_days(2019, 2, 1, 0));
  EXPECT_EQ(file.offset_s, 0);
  ASSERT_EQ(file.records.size(), 48u);
  for (std::size_t i = 0; i < 24; ++i) {
    const double moment_s = (static_cast<double>(i) + 1 - 0.8239) * 3600;
    EXPECT_NEAR((file.records[i].begin_s + file.records[i].end_s) / 2, moment_s, 1e-6);
    EXPECT_NEAR(file.records[i].end_s - file.records[i].begin_s, 3600, 1e-6);
  }
  ASSERT_EQ(file.notes.size(), 1u);
  EXPECT_NE(file.notes[0].find("10.6 min after the full hours of UTC (LOCATION says UTC+1)"),
            std::string::npos)
      << file.notes[0];
}

TEST(Epw, PartsOfAnHourFollowEachOther) {
  const auto file = read("a.epw", epw_header("0", 4, "1-Jun", "2-Jun") + epw_days(1999, 2, 4, 15));
  ASSERT_EQ(file.records.size(), 192u);
  for (std::size_t i = 0; i < 96; ++i) {
    EXPECT_EQ(file.records[i].begin_s, 900.0 * static_cast<double>(i));
    EXPECT_EQ(*file.records[i].values.dhi, static_cast<double>(i % 4));
  }
}

TEST(Epw, CodesAreMissing) {
  std::string text = epw_header("0", 1, "6/1", "6/1");
  const char* values[] = {"9999", "99999", "-999", "", "0", "-2", "812.5"};
  for (int hour = 1; hour <= 24; ++hour)
    text += epw_row(1999, 6, 1, hour, 0, "9999", hour <= 7 ? values[hour - 1] : "1", "10");
  const auto file = read("a.epw", text);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_FALSE(file.records[i].values.dni) << i;
  EXPECT_EQ(file.records[4].values.dni, 0.0);
  EXPECT_EQ(file.records[5].values.dni, 0.0);
  EXPECT_EQ(file.records[6].values.dni, 812.5);
  EXPECT_FALSE(file.records[8].values.ghi);
  EXPECT_EQ(file.offsets.count, 1u);
  EXPECT_EQ(file.too_low.count, 0u);
}

TEST(Epw, FilesThatAreNotWholeAreRefusedWithTheirLine) {
  const std::string header = epw_header("0", 1, "6/1", "6/3");
  const std::string all = header + epw_days(1999, 3, 1, 0);
  ASSERT_EQ(refused("a.epw", all), "");
  const std::string two_days = header + epw_days(1999, 2, 1, 0);
  EXPECT_NE(refused("a.epw", two_days).find("a.epw:50: the last row is of month 6, day 2"),
            std::string::npos);
  EXPECT_NE(refused("a.epw", all.substr(0, all.size() - 30)).find("a.epw:74: has"),
            std::string::npos);
  std::string short_day = all;
  short_day.resize(short_day.rfind("1999"));
  EXPECT_NE(refused("a.epw", short_day).find("the last day is not whole"), std::string::npos);
  std::string hole = all;
  const auto third = hole.find("1999,6,1,3");
  hole.erase(third, hole.find('\n', third) + 1 - third);
  EXPECT_NE(refused("a.epw", hole).find("a.epw:5: this is not the hour that follows"),
            std::string::npos);
  std::string strange = all;
  strange.replace(third, 10, "1999,6,1,x");
  EXPECT_NE(refused("a.epw", strange).find("a.epw:5: hour: 'x' is no number"), std::string::npos);
  EXPECT_NE(refused("a.epw", header).find("has no rows"), std::string::npos);
  EXPECT_NE(refused("a.epw", "LOCATION,a,b,c,d,e,95,0,0,0\n").find("a.epw:1: latitude: 95"),
            std::string::npos);
  EXPECT_NE(refused("a.epw", "LOCATION,a,b,c,d,e,5,0,0,0\n").find("DATA PERIODS is missing"),
            std::string::npos);
  EXPECT_NE(refused("a.epw", all, Stamp::start).find("light.stamp does not go with EPW"),
            std::string::npos);
  std::string bright = header + epw_days(1999, 3, 1, 0);
  bright.replace(bright.find("400"), 3, "4000");
  EXPECT_NE(refused("a.epw", bright).find("4000 W/m2 is not possible"), std::string::npos);
}

// ---- WEA

const std::string wea_header =
    "place X_Y\nlatitude 41.98\nlongitude 87.92\ntime_zone 90\nsite_elevation 201.0\n";

TEST(Wea, WestIsPositiveAndHoursAreMiddles) {
  const auto file = read("a.wea", wea_header +
                                      "weather_data_file_units 1\n1 1 7.5 22 10\n"
                                      "1 1 8.500 397 47\n1 3 9.5 587 71\n");
  EXPECT_EQ(file.place->longitude_deg, -87.92);
  EXPECT_EQ(*file.offset_s, -6 * 3600.0);
  EXPECT_EQ(file.records[0].begin_s, 7 * 3600.0);
  EXPECT_EQ(file.records[0].end_s, 8 * 3600.0);
  EXPECT_EQ(*file.records[1].values.dni, 397);
  EXPECT_EQ(file.records[2].day, 3);
}

TEST(Wea, UnitsTwoIsDirectHorizontalThreeIsRefused) {
  const std::string rows = "1 1 11.5 200 50\n1 1 12.5 300 60\n";
  const auto file = read("a.wea", wea_header + "weather_data_file_units 2\n" + rows);
  EXPECT_FALSE(file.records[0].values.dni);
  EXPECT_EQ(*file.records[0].values.ghi, 250);
  EXPECT_NE(refused("a.wea", wea_header + "weather_data_file_units 3\n" + rows)
                .find("a.wea:6: weather_data_file_units 3 is illuminance"),
            std::string::npos);
}

TEST(Wea, DecimalsOfHoursAreWholeMinutes) {
  const auto file = read("a.wea", wea_header +
                                      "weather_data_file_units 1\n1 1 0.000 0 0\n"
                                      "1 1 0.167 0 0\n1 1 0.333 0 0\n1 1 0.500 0 0\n");
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(file.records[i].begin_s, 600.0 * static_cast<double>(i) - 300);
}

TEST(Wea, WrongRowsAreNamed) {
  const std::string header = wea_header + "weather_data_file_units 1\n";
  EXPECT_NE(refused("a.wea", header + "1 1 7.5 22 10\n1 1 6.5 22 10\n").find("a.wea:8: this row"),
            std::string::npos);
  EXPECT_NE(refused("a.wea", header + "2 30 7.5 22 10\n").find("month 2, day 30 is no date"),
            std::string::npos);
  EXPECT_NE(refused("a.wea", header + "1 1 7.5 22\n").find("has 4 numbers"), std::string::npos);
  EXPECT_NE(refused("a.wea", "place x\nlongitude 3\n").find("a.wea:2: 'latitude' was expected"),
            std::string::npos);
  EXPECT_NE(refused("a.wea", header).find("has no rows"), std::string::npos);
}

// ---- TMY3

const std::string tmy3_head =
    "724666,\"DENVER, C\",CO,-7.0,39.742,-105.179,1829\n"
    "Date (MM/DD/YYYY),Time (HH:MM),ETR (W/m^2),GHI (W/m^2),DNI (W/m^2),DHI (W/m^2)\n";

TEST(Tmy3, StampsEndTheHourAndMonthsComeFromManyYears) {
  const auto file = read("a.csv", tmy3_head +
                                      "01/31/1988,23:00,0,1,2,3\n01/31/1988,24:00,0,4,5,6\n"
                                      "02/01/1995,01:00,0,-9900,7,8\n");
  EXPECT_EQ(file.format, "TMY3");
  EXPECT_EQ(years_of(file.records), WeatherYears::typical);
  EXPECT_EQ(file.records[1].begin_s, 23 * 3600.0);
  EXPECT_EQ(*file.records[1].values.ghi, 4);
  EXPECT_EQ(*file.records[1].values.dni, 5);
  EXPECT_EQ(*file.records[1].values.dhi, 6);
  EXPECT_FALSE(file.records[2].values.ghi);
  const auto weather = dated(file.records, 2001, *file.offset_s);
  EXPECT_EQ(weather[2].begin, weather[1].end);
  const auto twice = read("a.csv", tmy3_head +
                                       "01/31/1988,23:00,0,1,2,3\n01/31/1988,24:00,0,4,5,6\n"
                                       "01/31/1995,24:00,0,4,7,8\n");
  EXPECT_EQ(years_of(twice.records), WeatherYears::actual) << "a typical year has each day once";
  EXPECT_EQ(read("a.csv", tmy3_head + "01/31/1988,23:00,0,1,2,3\n01/31/1988,24:00,0,4,5,6\n",
                 Stamp::start)
                .records[0]
                .begin_s,
            23 * 3600.0);
}

// SolarAnywhere's heads.
TEST(Tmy3, ABracketMoreIsNoOtherColumn) {
  std::string head = tmy3_head;
  head.insert(head.find("DNI (W/m^2)") + 11, ")");
  const auto file = read("a.csv", head + "01/31/1988,23:00,0,1,2,3\n01/31/1988,24:00,0,4,5,6\n");
  EXPECT_EQ(*file.records[1].values.dni, 5);
}

TEST(Tmy3, WrongRowsAreNamed) {
  EXPECT_NE(
      refused("a.csv", tmy3_head + "1988-01-31,23:00,0,1,2,3\n").find("a.csv:3: '1988-01-31'"),
      std::string::npos);
  EXPECT_NE(refused("a.csv", tmy3_head + "01/31/1988,23:00,0,1,2\n").find("has 5 fields"),
            std::string::npos);
  EXPECT_NE(refused("a.csv", "1,2\nDate (MM/DD/YYYY),Time (HH:MM),GHI (W/m^2)\n")
                .find("the station has 2 fields"),
            std::string::npos);
}

// ---- CSV

TEST(WeatherCsv, ColumnsHaveNamesAndStampsASense) {
  const std::string rows =
      "# place: Roof\n# latitude_deg: 49.75\n# longitude_deg: 13.38\n# utc_offset: +01:00\n"
      "temperature;time;ghi_w_m2;dni\n21;2026-06-21T12:00;700;600\n22;2026-06-21T12:10;;nan\n";
  EXPECT_NE(refused("a.csv", rows).find("a.csv:5: nothing says what the times name"),
            std::string::npos);
  const double begins[] = {43200, 42900, 42600};
  for (const Stamp stamp : {Stamp::start, Stamp::middle, Stamp::end}) {
    const auto file = read("a.csv", rows, stamp);
    EXPECT_EQ(file.records[0].begin_s, begins[static_cast<int>(stamp)]);
    EXPECT_EQ(file.records[0].end_s - file.records[0].begin_s, 600);
    EXPECT_EQ(*file.offset_s, 3600);
    EXPECT_EQ(file.place->longitude_deg, 13.38);
    EXPECT_EQ(*file.records[0].values.ghi, 700);
    EXPECT_EQ(*file.records[0].values.dni, 600);
    EXPECT_FALSE(file.records[1].values.ghi);
    EXPECT_FALSE(file.records[1].values.dni);
  }
}

TEST(WeatherCsv, OffsetsMakeUtc) {
  const auto file = read("a.csv",
                         "time,dhi_w_m2,dni_w_m2\n2026-10-25T02:30:00+02:00,1,2\n"
                         "2026-10-25T02:30+01:00,3,4\n2026-10-25T02:30:30.5Z,5,6\n",
                         Stamp::start);
  const auto weather = dated(file.records, {}, *file.offset_s);
  EXPECT_EQ(iso_utc(weather[0].begin), "2026-10-25T00:30:00Z");
  EXPECT_EQ(iso_utc(weather[1].begin), "2026-10-25T01:30:00Z");
  EXPECT_EQ(iso_utc(weather[2].begin), "2026-10-25T02:30:30.500Z");
  const auto plain =
      read("a.csv", "date,time,ghi\n2026-06-21,23:00,0\n2026-06-21,24:00,0\n", Stamp::end);
  EXPECT_FALSE(plain.offset_s);
  EXPECT_EQ(plain.records[1].end_s, 86400);
}

/// Midnight is that of the clock which a row is written in: what ends an hour later is no hour of
/// the month before, which would make dates go back.
TEST(WeatherCsv, YearsWithOffsetsAreTheirOwn) {
  for (const auto& [offset, utc] :
       {std::pair("+01:00", "2024-02-28T23:00:00Z"), std::pair("Z", "2024-02-29T00:00:00Z"),
        std::pair("-05:00", "2024-02-29T05:00:00Z")}) {
    std::string rows = "time,ghi\n";
    const UnixTime begin = utc_from_calendar({2024, 2, 29, 0, 0, 0});
    for (int h = 1; h <= 48; ++h) {
      const CivilTime end = calendar_from_utc(begin + 3600. * h);
      rows +=
          fmt::format("2024-{:02}-{:02}T{:02}:00{},100\n", end.month, end.day, end.hour, offset);
    }
    const auto file = read("a.csv", rows, Stamp::end);
    ASSERT_EQ(years_of(file.records), WeatherYears::actual) << offset;
    const auto weather = dated(file.records, {}, *file.offset_s);
    EXPECT_EQ(iso_utc(weather.front().begin), utc);
    EXPECT_EQ(weather.back().end - weather.front().begin, 48 * 3600);
  }
}

/// 1 March of a leap year begins in UTC on the 29th of February, with rows of that day or without.
TEST(WeatherCsv, MarchOfALeapYearBeginsBehindItsLeapDay) {
  const std::string march = "2024-03-01T00:30+05:45,3\n2024-03-01T01:30+05:45,4\n";
  for (const char* before : {"", "2024-02-28T22:30+05:45,1\n2024-02-28T23:30+05:45,2\n",
                             "2023-06-01T11:30+05:45,1\n2023-06-01T12:30+05:45,2\n"}) {
    const auto file = read("a.csv", "time,ghi\n" + (before + march), Stamp::middle);
    const auto weather = dated(file.records, {}, *file.offset_s);
    EXPECT_EQ(iso_utc(weather.back().begin), "2024-02-29T19:15:00Z") << before;
    EXPECT_EQ(iso_utc(weather[weather.size() - 2].begin), "2024-02-29T18:15:00Z") << before;
  }
}

/// Of typical years, whose months are of different years and have no leap day.
TEST(WeatherCsv, WhatEndsWithThe28thOfFebruaryIsOfIt) {
  for (const auto& [offset, utc] :
       {std::pair("", "2001-02-28T23:00:00Z"), std::pair("+01:00", "2001-02-28T22:00:00Z")}) {
    std::string rows = "time,ghi\n";
    for (const CivilTime& day : {CivilTime{2005, 1, 31}, {2008, 2, 28}, {2005, 3, 1}}) {
      for (int h = 1; h <= 24; ++h) {
        const CivilTime end = calendar_from_utc(utc_from_calendar(day) + 3600. * h);
        rows += fmt::format("{}-{:02}-{:02}T{:02}:00{},{}\n", end.year, end.month, end.day,
                            end.hour, offset, day.month);
      }
    }
    const auto file = read("a.csv", rows, Stamp::end);
    ASSERT_EQ(years_of(file.records), WeatherYears::typical);
    const auto weather = dated(file.records, 2001, 0);
    ASSERT_EQ(weather.size(), 72u) << "none is of 29 February";
    EXPECT_EQ(iso_utc(weather[47].begin), utc);
    EXPECT_EQ(*weather[47].values.ghi, 2);
  }
}

/// Hours of days in June.
std::string june_of(int year) {
  std::string rows;
  for (int h = 0; h < 48; ++h)
    rows += fmt::format("{}-06-{:02}T{:02}:00,100\n", year, 1 + h / 24, h % 24);
  return rows;
}

TEST(WeatherCsv, CampaignsOfTheSameMonthAreOfTheirYears) {
  for (const Stamp stamp : {Stamp::start, Stamp::end}) {
    const auto file = read("a.csv", "time,ghi\n" + june_of(2022) + june_of(2023), stamp);
    EXPECT_EQ(years_of(file.records), WeatherYears::actual);
    ASSERT_EQ(file.records.size(), 96u);
    EXPECT_EQ(file.records[48].year, 2023);
  }
  const auto shuffled =
      refused("a.csv", "time,ghi\n" + june_of(2023) + june_of(2022), Stamp::start);
  EXPECT_NE(shuffled.find("a.csv:50: this row is not later"), std::string::npos) << shuffled;
}

/// Hours of a year whose months are of years that rise; stamps name the end.
std::string typical_year() {
  constexpr std::array years{1999, 1999, 2001, 2002, 2004, 2004,
                             2005, 2008, 2010, 2011, 2013, 2014};
  std::string rows = "time,ghi\n";
  const UnixTime begin = utc_from_calendar({2001, 1, 1, 0, 0, 0});
  for (int h = 1; h <= 8760; ++h) {
    const CivilTime row = calendar_from_utc(begin + 3600. * (h - 1));
    const int year = years[static_cast<std::size_t>(row.month - 1)];
    const CivilTime end =
        calendar_from_utc(utc_from_calendar({year, row.month, row.day, row.hour, 0, 0}) + 3600);
    rows += fmt::format("{}-{:02}-{:02}T{:02}:00,{}\n", end.year, end.month, end.day, end.hour,
                        row.month);
  }
  return rows;
}

/// The first of January that ends December is its last hour, whatever year is written.
TEST(WeatherCsv, TypicalYearsOfEndStampsEndWithDecember) {
  for (const bool is_first : {false, true}) {
    std::string text = typical_year();
    if (is_first) {  // as written by those who begin with 00:00
      const auto last = text.rfind("2015-01-01T00:00");
      const std::string row = text.substr(last);
      text.erase(last);
      text.insert(text.find('\n') + 1, "1999" + row.substr(4));
    }
    const auto file = read("a.csv", text, Stamp::end);
    ASSERT_EQ(file.records.size(), 8760u);
    ASSERT_EQ(years_of(file.records), WeatherYears::typical) << is_first;
    const auto weather = dated(file.records, 2001, 0);
    EXPECT_EQ(iso_utc(weather.front().begin), "2001-01-01T00:00:00Z");
    EXPECT_EQ(iso_utc(weather.back().end), "2002-01-01T00:00:00Z");
    for (const auto& w : weather)
      EXPECT_EQ(*w.values.ghi, calendar_from_utc(w.begin).month) << iso_utc(w.begin);
  }
}

TEST(WeatherCsv, WrongRowsAreNamed) {
  const auto wrong = [&](const std::string& rows) {
    return refused("a.csv", "time,ghi\n" + rows, Stamp::end);
  };
  EXPECT_NE(wrong("21.6.2026 12:00,5\n").find("a.csv:2: '21.6.2026 12:00' is no time"),
            std::string::npos);
  EXPECT_NE(wrong("2026-02-29T12:00,5\n").find("2026-02-29 is no date"), std::string::npos);
  EXPECT_NE(wrong("2026-02-28T12:00,5\n2026-02-28T13:00Z,5\n").find("a.csv:3: some rows have an"),
            std::string::npos);
  EXPECT_NE(wrong("2026-02-28T12:00,bright\n").find("ghi: 'bright' is no number"),
            std::string::npos);
  EXPECT_NE(wrong("2026-02-28T12:00\n").find("has 1 fields"), std::string::npos);
  EXPECT_NE(
      wrong("2026-02-28T12:00,1\n2026-02-28T12:00,1\n").find("a.csv:3: this row is not later"),
      std::string::npos);
}

// ---- Broken files: an answer or InputError with the file's name, never anything else.

std::string shuffled(const std::string& text, std::mt19937& random) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line + "\n");
  std::shuffle(lines.begin() + std::min<std::ptrdiff_t>(8, std::ssize(lines)), lines.end(), random);
  std::string all;
  for (const auto& line : lines) all += line;
  return all;
}

TEST(WeatherCsv, CivilTimesOfAutumnAreToldWhatToWrite) {
  const auto hint = [](const std::string& rows) {
    return refused("a.csv", "time,ghi\n" + rows, Stamp::start).find("whose clocks go back here") !=
           std::string::npos;
  };
  EXPECT_TRUE(hint("2026-10-25T01:00,0\n2026-10-25T02:00,0\n2026-10-25T02:00,0\n"));
  EXPECT_TRUE(hint("2026-10-25T02:30,0\n2026-10-25T02:45,0\n2026-10-25T02:00,0\n"));
  EXPECT_FALSE(hint("2026-10-25T02:30,0\n2026-10-25T02:45,0\n2026-10-25T02:30,0\n"));
}

TEST(BrokenWeather, IsRefusedAndNeverCrashes) {
  std::mt19937 random(5);
  int refusals = 0, read_anyway = 0;
  // The CSV alone does not say what its times name.
  const std::pair<std::string, std::optional<Stamp>> files[]{
      {test::small_wea(), {}}, {test::small_epw(), {}}, {test::small_csv(), Stamp::end}};
  for (const auto& file : files) {
    std::string text = file.first;
    const auto stamp = file.second;
    EXPECT_EQ(refused("whole.txt", text, stamp), "");
    // Enough of the file: header and some days.
    text.resize(std::min<std::size_t>(text.size(), 60'000));
    const auto attempt = [&](const std::string& broken) {
      refused("broken.txt", broken, stamp).empty() ? ++read_anyway : ++refusals;
    };
    EXPECT_NE(refused("broken.txt", shuffled(text, random), stamp), "") << text.substr(0, 100);
    for (int i = 0; i < 80; ++i) {
      attempt(text.substr(0, random() % text.size()));
      std::string bytes = text;
      for (int flips = 0; flips < 1 + i; ++flips)
        bytes[random() % bytes.size()] = static_cast<char>(random());
      attempt(bytes);
      std::string moved = text;
      std::rotate(moved.begin(),
                  moved.begin() + static_cast<std::ptrdiff_t>(random() % moved.size()),
                  moved.end());
      attempt(moved);
      std::string noise(1 + random() % 2000, '\0');
      for (char& c : noise) c = static_cast<char>(random());
      attempt(noise);
      attempt(text.substr(0, 300) + noise);
    }
  }
  EXPECT_EQ(refused("broken.txt", "").empty(), false);
  std::cout << refusals << " refused, " << read_anyway << " read\n";
  EXPECT_GT(refusals, 1000);
}

/// `FORMAT` of two rows with DNI, DHI and GHI, of which it may lack the last.
std::string text_with(const std::string& format, const std::string& dni, const std::string& dhi,
                      const std::string& ghi) {
  if (format == "TMY3")
    return tmy3_head + "06/21/1988,12:00,0,1,1,1\n06/21/1988,13:00,0," + ghi + "," + dni + "," +
           dhi + "\n";
  if (format == "CSV")
    return "time,ghi,dni,dhi\n2026-06-21T12:00,1,1,1\n2026-06-21T13:00," + ghi + "," + dni + "," +
           dhi + "\n";
  if (format == "WEA")
    return "place a\nlatitude 50\nlongitude -14\ntime_zone -15\nsite_elevation 250\n"
           "weather_data_file_units 1\n6 21 11.5 1 1\n6 21 12.5 " +
           dni + " " + dhi + "\n";
  std::string text = epw_header("0", 1, "6/1", "6/1");
  for (int hour = 1; hour <= 24; ++hour)
    text += hour == 2 ? epw_row(1999, 6, 1, hour, 0, ghi, dni, dhi)
                      : epw_row(1999, 6, 1, hour, 0, "1", "1", "1");
  return text;
}

TEST(ValuesBelowZero, AreOffsetsOfInstrumentsCodesOrTooLow) {
  const struct {
    const char* written;
    std::optional<double> taken;
    std::size_t offsets, too_low;
  } cases[] = {
      {"-0", 0, 0, 0},      {"-0.4", 0, 1, 0},    {"-4.5", 0, 1, 0},   {"-8.9", 0, 1, 0},
      {"-9", {}, 0, 0},     {"-9.0", {}, 0, 0},   {"-9.9", {}, 0, 0},  {"-9.99", {}, 0, 0},
      {"-10", 0, 1, 0},     {"-15", 0, 1, 0},     {"-15.1", {}, 0, 1}, {"-60", {}, 0, 1},
      {"-99", {}, 0, 0},    {"-99.9", {}, 0, 0},  {"-100", {}, 0, 1},  {"-998", {}, 0, 1},
      {"-999", {}, 0, 0},   {"-999.9", {}, 0, 0}, {"-6999", {}, 0, 0}, {"-9900", {}, 0, 0},
      {"-99999", {}, 0, 0},
  };
  for (const std::string format : {"EPW", "TMY3", "WEA", "CSV"})
    for (const auto& each : cases) {
      const std::string of = format + " " + each.written;
      const auto file = read("a.txt", text_with(format, each.written, "2", "3"),
                             format == "CSV" ? std::optional(Stamp::end) : std::nullopt);
      ASSERT_EQ(file.format, format);
      const auto& dni = file.records[1].values.dni;
      EXPECT_EQ(dni, each.taken) << of;
      EXPECT_FALSE(dni && std::signbit(*dni)) << of;
      EXPECT_EQ(file.offsets.count, each.offsets) << of;
      EXPECT_EQ(file.too_low.count, each.too_low) << of;
    }
}

TEST(ValuesBelowZero, OfAllThreeQuantitiesAreCountedWithTheFirstAndTheLowest) {
  const auto file = read("a.csv",
                         "time,dni,dhi,ghi\n2026-06-21T12:00,1,-2.5,-3\n"
                         "2026-06-21T13:00,-14,-20,0\n2026-06-21T14:00,-1,0,-30\n",
                         Stamp::end);
  EXPECT_EQ(file.offsets.count, 4u);
  EXPECT_EQ(file.offsets.lowest_w_m2, -14);
  EXPECT_EQ(file.offsets.line, 2);
  EXPECT_EQ(file.offsets.first, "dhi: -2.5 W/m2");
  EXPECT_EQ(file.too_low.count, 2u);
  EXPECT_EQ(file.too_low.lowest_w_m2, -30);
  EXPECT_EQ(file.too_low.line, 3);
  EXPECT_EQ(file.too_low.first, "dhi: -20 W/m2");
  EXPECT_EQ(file.records[0].values.ghi, 0.0);
  EXPECT_FALSE(file.records[1].values.dhi);
}

// An EPW that is cut off anywhere is never taken for a whole one.
TEST(BrokenWeather, CutOffEpwIsNeverTakenForWhole) {
  const std::string all = epw_header("0", 1, "6/1", "6/2") + epw_days(1999, 2, 1, 0);
  // All lengths within the last two rows, and some before.
  const std::size_t two_rows = all.size() - 120;
  for (std::size_t size = 0; size + 7 < all.size(); size += size < two_rows ? 37 : 1)
    EXPECT_NE(refused("a.epw", all.substr(0, size)), "") << size << " of " << all.size();
}

}  // namespace
}  // namespace sunload
