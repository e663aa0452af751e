// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Series of steps of the clock against those of intervals that they are means of.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "geo/base/units.h"
#include "io/result/reader.h"
#include "tests/support/program.h"
#include "tests/support/result_check.h"
#include "tests/support/small_study.h"

namespace sunload::test {
namespace {

/// Three days about a change of clocks, 71 hours in batches that cut days and steps of hours.
std::string three_days(const std::string& name, const std::string& output,
                       const std::string& solver = "") {
  return "format: sunload-study-1\nname: " + name +
         "\n"
         "site: {latitude_deg: 49.7475, longitude_deg: 13.3776, timezone: Europe/Prague}\n"
         "period: {start: 2026-03-28T00:00, end: 2026-03-31T00:00, step_min: 60}\n"
         "light: {source: clear_sky}\n"
         "scene: {files: [square.obj], materials: {paving: {diffuse: 0.3}, plaster: {diffuse: 0.6},"
         " glass: {diffuse: 0.05, mirror: 0.85}, canvas: {diffuse: 0.5, sides: two},"
         " lamp: {diffuse: 0.1, emission_w_m2: 200}}}\n"
         "mesh: {oracle: none, max_edge_m: 4}\n"
         "sensors: {points: [{position_m: [0, 0, 1.5], normal: [0, 0, 1]}]}\n"
         "measures: {bright: {rule: light_hours, above_w_m2: 100, light: direct}, "
         "peak: {rule: peak_light}}\n"
         "solver: {lines_per_patch: 64, realizations: 8, batch_suns: 10" +
         solver + "}\noutput: {folder: results, series: [total, direct]" + output + "}\n";
}

/// Studies named `name`, all in one folder.
const WorkFolder& folder_with(const std::string& name, const std::string& output,
                              const std::string& solver = "") {
  static WorkFolder folder;
  static std::vector<std::string> run;
  if (std::find(run.begin(), run.end(), name) != run.end()) return folder;
  run.push_back(name);
  folder.write("square.obj", square_obj);
  folder.write(name + ".yaml", three_days(name, output, solver));
  const Ran ran = program(folder, {"run", name + ".yaml"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  return folder;
}

std::string result_of(const std::string& name) { return "results/" + name + "/baseline.h5"; }

std::string intervals(const std::string& solver = "") {
  const std::string name = solver.empty() ? "intervals" : "intervals_rgb";
  return folder_with(name, "", solver) / result_of(name);
}
std::string days(const std::string& solver = "") {
  const std::string name = solver.empty() ? "days" : "days_rgb";
  return folder_with(name, ", series_step: day", solver) / result_of(name);
}
std::string fours() {
  return folder_with("fours", ", series_step: 240 min, significant_bits: 8") / result_of("fours");
}

/// Means of the fine result's rows over the coarse one's time, [coarse rows][n].
std::vector<double> means(const ResultReader& fine, const ResultReader& coarse,
                          const std::string& dataset) {
  const auto fine_bounds = fine.doubles("time_bounds"), bounds = coarse.doubles("time_bounds"),
             values = fine.doubles(dataset);
  const std::size_t n = values.size() / (fine_bounds.size() / 2);
  std::vector<double> sums(bounds.size() / 2 * n, 0);
  for (std::size_t row = 0; row < bounds.size() / 2; ++row)
    for (std::size_t k = 0; k < fine_bounds.size() / 2; ++k) {
      const double shared = std::min(bounds[2 * row + 1], fine_bounds[2 * k + 1]) -
                            std::max(bounds[2 * row], fine_bounds[2 * k]);
      if (shared <= 0) continue;
      for (std::size_t i = 0; i < n; ++i)
        sums[row * n + i] += shared / (bounds[2 * row + 1] - bounds[2 * row]) * values[k * n + i];
    }
  return sums;
}

void expect_means(const std::string& of_intervals, const std::string& of_steps, double tolerance) {
  const ResultReader fine(of_intervals), coarse(of_steps);
  for (const char* dataset : {"irradiance", "irradiance_direct", "facade_irradiance",
                              "sensor_irradiance", "sensor_irradiance_direct", "power_sun",
                              "power_absorbed", "power_residual", "dni", "ghi"}) {
    const auto expected = means(fine, coarse, dataset), found = coarse.doubles(dataset);
    ASSERT_EQ(found.size(), expected.size()) << dataset;
    const double largest = *std::max_element(expected.begin(), expected.end());
    for (std::size_t i = 0; i < found.size(); ++i)
      ASSERT_NEAR(found[i], expected[i], tolerance * std::abs(expected[i]) + 1e-6 * largest)
          << dataset << " at place " << i;
  }
}

TEST(SeriesSteps, AreMeansOfIntervals) {
  expect_means(intervals(), days(), 1e-6);
  expect_means(intervals(), fours(), std::exp2(-9));
  const ResultReader coarse(days());
  EXPECT_EQ(coarse.shape("irradiance").front(), 3U);
  EXPECT_EQ(coarse.text_attribute("series_step"), "day");
  const auto bounds = coarse.doubles("time_bounds");
  EXPECT_EQ(bounds[3] - bounds[2], 23 * seconds_per_hour);
  EXPECT_EQ(ResultReader(fours()).shape("irradiance").front(), 18U);
}

TEST(SeriesSteps, HaveBands) {
  const std::string rgb = ", bands: rgb";
  const ResultReader coarse(days(rgb), 0), fine(intervals(rgb), 0);
  const auto expected = means(fine, coarse, "irradiance"), found = coarse.doubles("irradiance");
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    ASSERT_NEAR(found[i], expected[i], 1e-6 * expected[i] + 1e-6);
}

/// Totals, largest values, sun hours and measures are those of the intervals, to the last bit.
TEST(SeriesSteps, LeaveAllElseAsItIs) {
  for (const std::string& of_steps : {days(), fours()})
    for (const auto& name : different_data(intervals(), of_steps)) {
      const ResultReader fine(intervals());
      const auto shape = fine.has(name) ? fine.shape(name) : std::vector<std::size_t>{};
      EXPECT_TRUE(name == "study_yaml" || (!shape.empty() && shape.front() == 71U)) << name;
    }
  EXPECT_TRUE(ResultReader(days()).has("measure_bright"));
  EXPECT_TRUE(ResultReader(days()).has("measure_peak"));
}

// Measures of a result that stores intervals see what it stores, and say so.
TEST(SeriesSteps, RoundedIntervalsAreToldByMeasures) {
  const std::string rounded =
      folder_with("rounded", ", significant_bits: 8") / result_of("rounded");
  const auto definition = [](const std::string& path) {
    return ResultReader(path).text_attribute("sensor_measure_peak", "definition");
  };
  EXPECT_NE(definition(rounded).find("of values rounded to 8 bits (0.2 %)"), std::string::npos)
      << definition(rounded);
  for (const std::string& exact : {intervals(), fours()})
    EXPECT_EQ(definition(exact).find("rounded"), std::string::npos) << exact;
}

TEST(SeriesSteps, AreTheSameBitsInShards) {
  const WorkFolder folder;
  folder.write("square.obj", square_obj);
  folder.write("fours.yaml", three_days("fours", ", series_step: 240 min, significant_bits: 8"));
  const auto shard = [&](const char* which) {
    const Ran ran = program(folder, {"run", "fours.yaml", "--resume", "--shard", which});
    EXPECT_EQ(ran.code, 0) << ran.err;
  };
  shard("2/3");
  shard("0/3");
  // The third step begins in the first batch and ends in the second, which is not there.
  const Ran partial = program(folder, {"merge", "fours.yaml", "--partial"});
  EXPECT_EQ(partial.code, 0) << partial.err;
  std::string path;
  for (const auto& name : folder.content("results"))
    if (name.ends_with("partial.h5")) path = folder / ("results/" + name);
  const ResultReader half(path);
  EXPECT_FALSE(std::isnan(half.row("irradiance", 1)[0]));
  EXPECT_TRUE(std::isnan(half.row("irradiance", 2)[0]));
  EXPECT_TRUE(std::isnan(half.row("power_sun", 2)[0]));
  shard("1/3");
  EXPECT_EQ(different_data(folder / result_of("fours"), fours()), std::vector<std::string>{});
}

TEST(SeriesSteps, OfAnotherLengthAreComputedAgain) {
  const WorkFolder folder;
  folder.write("square.obj", square_obj);
  const auto run = [&](const std::string& step, std::vector<std::string> options) {
    folder.write("days.yaml", three_days("days", ", series_step: " + step));
    options.insert(options.begin(), {"run", "days.yaml"});
    const Ran ran = program(folder, options);
    EXPECT_EQ(ran.code, 0) << ran.err;
  };
  run("month", {"--keep-batches"});
  run("day", {"--overwrite"});
  EXPECT_EQ(different_data(folder / result_of("days"), days()), std::vector<std::string>{});
}

TEST(SeriesSteps, AreToldAndRefusedByCommands) {
  const WorkFolder& folder = folder_with("days", ", series_step: day");
  days(), intervals();
  const std::string path = result_of("days");
  const auto out = [&](std::vector<std::string> arguments) {
    const Ran ran = program(folder, std::move(arguments));
    EXPECT_EQ(ran.code, 0) << ran.err;
    return ran.out + ran.err;
  };
  const auto refused = [&](std::vector<std::string> arguments) {
    const Ran ran = program(folder, std::move(arguments));
    EXPECT_EQ(ran.code, 2) << ran.err;
    return ran.err;
  };
  const auto has = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  has(out({"info", path}), "means over steps: day");
  has(out({"info", path, "--day", "2026-03-29"}), "23 h in all");
  has(refused({"info", path, "--hours", "8-12"}), "cuts steps of the series");
  has(out({"compare", path, result_of("intervals")}), "series of other steps: day and interval");
  out({"render", path, "--quantity", "irradiance", "--time", "2026-03-29T12:00", "--size",
       "400x320", "-o", "day.png"});
  has(refused({"render", path, "--camera", "sun", "--time", "2026-03-29T12:00", "-o", "sun.png"}),
      "no one sun stands");
  out({"export", path, "--to", "csv", "--quantity", "irradiance", "--time", "2026-03-29T12:00",
       "-o", "day.csv"});
  has(refused({"export", path, "--to", "energyplus", "-o", "shade.csv"}), "means over steps: day");
  has(out({"explain", path, "--object", "house", "--day", "2026-03-29"}), "house");
  const auto disk = [&](const char* study) {
    return nlohmann::json::parse(
               program(folder, {"check", study, "--json"}).out)["variants"][0]["disk_bytes"]
        .get<double>();
  };
  EXPECT_LT(disk("days.yaml"), disk("intervals.yaml"));
}

}  // namespace
}  // namespace sunload::test
