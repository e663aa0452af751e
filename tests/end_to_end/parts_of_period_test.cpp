// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Totals of parts of the period, as users ask for them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "io/result/reader.h"
#include "tests/support/program.h"
#include "tests/support/result_check.h"
#include "tests/support/small_study.h"

namespace sunload::test {
namespace {

/// A summer and a winter day, in batches that cut days and hours.
std::string two_days(const std::string& output, const std::string& scene = "") {
  return "format: sunload-study-1\n"
         "name: days\n"
         "site: {latitude_deg: 49.7475, longitude_deg: 13.3776, timezone: Europe/Prague}\n"
         "period: {days: [2026-06-21, 2026-12-21], from: \"07:30\", to: \"16:30\", step_min: 90}\n"
         "light: {source: clear_sky}\n"
         "scene: {files: [square.obj], materials: {paving: {diffuse: 0.3}, plaster: {diffuse: 0.6},"
         " glass: {diffuse: 0.1}, canvas: {diffuse: 0.5, sides: two}, lamp: {diffuse: 0.1}}}\n"
         "mesh: {oracle: none, max_edge_m: 4}\n"
         "sensors: {points: [{position_m: [0, 0, 1.5], normal: [0, 0, 1]}]}\n"
         "solver: {lines_per_patch: 64, realizations: 8, batch_suns: 5}\n"
         "output: {folder: results" +
         output + "}\n" + scene;
}

constexpr const char* path = "results/days/baseline.h5";

WorkFolder& days_folder() {
  static WorkFolder folder;
  static const bool is_run = [] {
    folder.write("square.obj", square_obj);
    folder.write("days.yaml",
                 two_days("",
                          "variants:\n  - {name: baseline}\n"
                          "  - {name: dark, scene: {materials: {paving: {diffuse: 0.1}}}}\n"
                          "  - {name: winter, period: {days: [2026-12-21]}}\n"
                          "  - {name: slow, period: {days: [2026-12-21], step_min: 180}}\n"));
    const Ran ran = program(folder, {"run", "days.yaml"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    return true;
  }();
  EXPECT_TRUE(is_run);
  return folder;
}

ResultReader& chosen(ResultReader& result, const PeriodChoice& choice) {
  result.choose(choice);
  return result;
}

TEST(PartsOfPeriod, DaysAndMonthsAreThereByThemselves) {
  const ResultReader result(days_folder() / path);
  EXPECT_EQ(sums_problem(days_folder() / path), "");
  EXPECT_EQ(result.strings("month"), (std::vector<std::string>{"2026-06", "2026-12"}));
  EXPECT_EQ(result.strings("day"), (std::vector<std::string>{"2026-06-21", "2026-12-21"}));
  EXPECT_EQ(result.doubles("day_duration"), (std::vector<double>{9, 9}));
  EXPECT_FALSE(result.has("season"));
  // Both divide the period alike: solved once.
  EXPECT_EQ(result.doubles("light_load_by_day_realization"),
            result.doubles("light_load_by_month_realization"));
  const auto se = result.doubles("light_load_by_day_se"),
             load = result.doubles("light_load_by_day");
  EXPECT_GT(*std::max_element(se.begin(), se.end()), 0);
  EXPECT_GT(result.row("light_load_by_day", 0)[0], 2 * result.row("light_load_by_day", 1)[0]);
}

/// What a chosen part has is the sum of the series over its intervals.
TEST(PartsOfPeriod, StoredOnesAndSumsOfSeriesAgree) {
  ResultReader result(days_folder() / path);
  const auto whole = result.doubles("light_load");
  const auto of_day = chosen(result, {.day = "2026-12-21"}).doubles("light_load");
  EXPECT_TRUE(result.has("light_load_se"));
  EXPECT_EQ(result.shape("light_load_realization"), (std::vector<std::size_t>{8, whole.size()}));
  EXPECT_EQ(result.row("light_load_realization", 3).size(), whole.size());
  const auto sun = result.doubles("sun_hours");
  EXPECT_LE(*std::max_element(sun.begin(), sun.end()), 9);
  // No stored part begins at noon.
  const auto late = chosen(result, {.day = "2026-12-21", .hours = "12-24"}).doubles("light_load");
  EXPECT_FALSE(result.has("light_load_se"));
  EXPECT_FALSE(result.has("sun_hours"));
  const auto early = chosen(result, {.day = "2026-12-21", .hours = "0-12"}).doubles("light_load");
  for (std::size_t i = 0; i < whole.size(); ++i)
    EXPECT_NEAR(early[i] + late[i], of_day[i], 1e-5 * whole[i] + 1e-12);
  EXPECT_EQ(chosen(result, {.from = "2026-01-01"}).doubles("light_load"), whole);
  EXPECT_TRUE(result.has("power_load"));
}

TEST(PartsOfPeriod, AllCommandsOnResultsTakeThem) {
  WorkFolder& folder = days_folder();
  const auto ran = [&](std::vector<std::string> arguments) {
    Ran done = program(folder, std::move(arguments));
    EXPECT_EQ(done.code, 0) << done.err;
    return done;
  };
  const std::string winter = "2026-12-21";
  const auto info = ran({"info", path}).out;
  EXPECT_NE(info.find("by day"), std::string::npos) << info;
  EXPECT_NE(info.find("2026-06-21, 2026-12-21"), std::string::npos) << info;
  EXPECT_NE(ran({"info", path, "--season", "winter"}).out.find("9 h in all"), std::string::npos);
  const auto all = ran({"info", path, "--facades", "--csv"}).out,
             part = ran({"info", path, "--facades", "--csv", "--day", winter}).out;
  EXPECT_NE(all, part);
  const auto compared = ran({"compare", path, "results/days/dark.h5", "--month", "12", "--csv"});
  EXPECT_NE(compared.out.find("true"), std::string::npos) << compared.out;  // paired
  EXPECT_NE(compared.err.find(winter), std::string::npos) << compared.err;
  EXPECT_NE(compared.out, ran({"compare", path, "results/days/dark.h5", "--csv"}).out);
  ran({"render", path, "--day", winter, "--size", "400x320", "-o", "day.png"});
  ran({"export", path, "--to", "csv", "--month", "6", "-o", "june.csv"});
  const Ran never = program(folder, {"info", path, "--month", "4"});
  EXPECT_EQ(never.code, 2);
  EXPECT_NE(never.err.find("2026-06-21, 2026-12-21"), std::string::npos) << never.err;
  EXPECT_EQ(
      program(folder, {"render", path, "--month", "6", "--time", "2026-06-21T12:00", "-o", "x.png"})
          .code,
      2);
}

/// The winter day is the second half of one period and all of the other.
// An export has the rows of the part, or says that it cannot.
TEST(PartsOfPeriod, ExportsTakeThemOrRefuse) {
  const WorkFolder& folder = days_folder();
  const auto exported = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"export", path});
    return program(folder, more);
  };
  const auto rows = [](const std::string& csv) { return std::count(csv.begin(), csv.end(), '\n'); };
  const Ran whole = exported({"--to", "csv", "--quantity", "series"});
  const Ran day = exported({"--to", "csv", "--quantity", "series", "--day", "2026-12-21"});
  EXPECT_EQ(day.code, 0) << day.err;
  EXPECT_EQ(rows(whole.out), 1 + 12);  // a line of names, six intervals of each day
  EXPECT_EQ(rows(day.out), 1 + 6);
  EXPECT_NE(day.out.find("2026-12-21"), std::string::npos);
  EXPECT_EQ(day.out.find("2026-06-21"), std::string::npos);
  for (const auto& refused :
       {std::vector<std::string>{"--to", "xdmf", "-o", "x.xdmf"},
        {"--to", "csv", "--quantity", "irradiance", "--time", "2026-06-21T12:00"}}) {
    auto words = refused;
    words.insert(words.end(), {"--day", "2026-12-21"});
    const Ran ran = exported(words);
    EXPECT_EQ(ran.code, 2) << ran.out;
    EXPECT_NE(ran.err.find("--day"), std::string::npos) << ran.err;
  }
}

TEST(PartsOfPeriod, ResultsOfOtherPeriodsArePairsWhereTheyHaveThePart) {
  WorkFolder& folder = days_folder();
  const std::string winter = "results/days/winter.h5", slow = "results/days/slow.h5";
  const auto compared = [&](const std::string& variant, std::vector<std::string> more) {
    std::vector<std::string> words{"compare", path, variant};
    words.insert(words.end(), more.begin(), more.end());
    const Ran ran = program(folder, words);
    EXPECT_EQ(ran.code, 0) << ran.err;
    return ran.out + ran.err;
  };
  const auto has = [](const std::string& text, const char* words) {
    return text.find(words) != std::string::npos;
  };
  const std::string part = compared(winter, {"--month", "12"}), whole = compared(winter, {}),
                    other_steps = compared(slow, {"--month", "12"});
  EXPECT_TRUE(has(part, "standard errors of paired differences")) << part;
  EXPECT_FALSE(has(part, "different intervals")) << part;
  EXPECT_TRUE(has(whole, "standard errors of both results added")) << whole;
  EXPECT_TRUE(has(whole, "cover different intervals of time")) << whole;
  EXPECT_TRUE(has(other_steps, "standard errors of both results added")) << other_steps;
  EXPECT_TRUE(has(other_steps, "into different intervals, 6 and 3")) << other_steps;
  const auto explained = program(
      folder, {"explain", winter, "--object", "square", "--against", path, "--month", "12"});
  EXPECT_TRUE(has(explained.out, "paired realizations")) << explained.out << explained.err;
  EXPECT_FALSE(has(explained.out, "different intervals")) << explained.out;
}

// Hours cut the intervals; nothing but totals is kept.
TEST(PartsOfPeriod, AreThereWithoutSeries) {
  const WorkFolder folder;
  folder.write("square.obj", square_obj);
  folder.write("days.yaml", two_days(", totals: [season, hour_of_day], series: [direct]"));
  const Ran ran = program(folder, {"run", "days.yaml"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  ResultReader result(folder / path);
  EXPECT_EQ(result.integers("hour_of_day").front(), 7);
  EXPECT_EQ(result.shape("light_load_by_hour_of_day").front(), 10U);
  EXPECT_TRUE(chosen(result, {.season = "summer"}).has("light_load_se"));
  EXPECT_TRUE(chosen(result, {.month = "12"}).has("light_load_se"));  // all of the winter
  EXPECT_TRUE(chosen(result, {.hours = "8-12"}).has("light_load_se"));
  EXPECT_EQ(result.doubles("light_load_se").size(), result.shape("light_load").front());
  const Ran unknown = program(folder, {"info", path, "--month", "6", "--hours", "8-12"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.err.find("output.series: [total]"), std::string::npos) << unknown.err;
}

}  // namespace
}  // namespace sunload::test
