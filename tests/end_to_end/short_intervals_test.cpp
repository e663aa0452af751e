// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Intervals that are solved together against the same one by one.
#include <gtest/gtest.h>

#include <cmath>

#include "io/result/reader.h"
#include "tests/support/program.h"
#include "tests/support/result_check.h"
#include "tests/support/small_study.h"

namespace sunload::test {
namespace {

/// A day of five minutes, in batches of four hours.
std::string day_of(const std::string& name, const std::string& solver,
                   const std::string& output = "series_step: 60 min") {
  return "format: sunload-study-1\nname: " + name +
         "\n"
         "site: {latitude_deg: 49.7475, longitude_deg: 13.3776, timezone: Europe/Prague}\n"
         "period: {start: 2026-06-21, end: 2026-06-22, step_min: 5}\n"
         "light: {source: clear_sky, sky: perez}\n"
         "scene: {files: [square.obj], materials: {paving: {diffuse: 0.3}, plaster: {diffuse: 0.6},"
         " glass: {diffuse: 0.05, mirror: 0.85}, canvas: {diffuse: 0.5, sides: two},"
         " lamp: {diffuse: 0.1, emission_w_m2: 2}}}\n"
         "mesh: {oracle: none, max_edge_m: 2}\n"
         "sensors: {points: [{position_m: [0, 0, 1.5], normal: [0, 0, 1]}]}\n"
         "solver: {lines_per_patch: 256, realizations: 8, batch_suns: 4" +
         solver + "}\noutput: {folder: results, " + output + "}\n";
}

std::string result_of_run(const WorkFolder& folder, const std::string& name,
                          const std::string& study, std::vector<std::string> options = {}) {
  folder.write("square.obj", square_obj);
  folder.write(name + ".yaml", study);
  options.insert(options.begin(), {"run", name + ".yaml"});
  const Ran ran = program(folder, options);
  EXPECT_EQ(ran.code, 0) << ran.err;
  return folder / ("results/" + name + "/baseline.h5");
}

double total_of(const std::vector<double>& values, const std::vector<double>& area) {
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += values[i] * area[i];
  return sum;
}

TEST(ShortIntervals, TogetherHaveTheLightOfEach) {
  const WorkFolder folder;
  const ResultReader each(
      result_of_run(folder, "each", day_of("each", ", year: each, short_intervals: each"))),
      together(
          result_of_run(folder, "together", day_of("together", ", short_intervals: together")));
  const auto area = each.doubles("patch_area");
  EXPECT_EQ(each.doubles("time_bounds"), together.doubles("time_bounds"));
  // Sky and reflected light come from the same lines, and from the mean of what they carry.
  for (const char* part : {"light_load", "light_load_sky", "light_load_direct", "sun_hours"}) {
    const double a = total_of(each.doubles(part), area), b = total_of(together.doubles(part), area);
    EXPECT_NEAR(b / a, 1, 2e-3) << part;
  }
  // By mirrors and by reflection within what fewer suns and other samples change.
  for (const char* part : {"light_load_mirror", "light_load_reflected"}) {
    const double a = total_of(each.doubles(part), area), b = total_of(together.doubles(part), area);
    EXPECT_NEAR(b / a, 1, 0.02) << part;
  }
  const auto direct = each.doubles("light_load_direct"),
             other = together.doubles("light_load_direct"), hours = each.doubles("sun_hours"),
             other_hours = together.doubles("sun_hours");
  double squares = 0, mean = 0, worst_h = 0;
  for (std::size_t i = 0; i < direct.size(); ++i) {
    squares += std::pow(other[i] - direct[i], 2) / static_cast<double>(direct.size());
    mean += direct[i] / static_cast<double>(direct.size());
    worst_h = std::max(worst_h, std::abs(hours[i] - other_hours[i]));
  }
  EXPECT_LT(std::sqrt(squares), 0.01 * mean);
  EXPECT_LT(worst_h, 0.25);
  const auto dni = each.doubles("dni"), other_dni = together.doubles("dni");
  for (std::size_t k = 0; k < dni.size(); ++k) EXPECT_NEAR(dni[k], other_dni[k], 1e-3 * dni[k]);
  const auto at_sensor = each.doubles("sensor_light_load"),
             at_other = together.doubles("sensor_light_load");
  EXPECT_NEAR(at_other[0] / at_sensor[0], 1, 0.02);
  const std::string path = folder / "results/together/baseline.h5";
  EXPECT_EQ(ledger_problem(path), "");
  EXPECT_EQ(sums_problem(path), "");
}

// Two mirrors that face each other a hand apart, behind a screen: what they get of the sun only
// rays can tell, and little of what their size would let one guess.
TEST(ShortIntervals, MatchWhatIsSentOnWhereRaysTellIt) {
  const WorkFolder folder;
  folder.write("slit.obj",
               "o mirrors\nusemtl mirror\n"
               "v 10 -14 0\nv 14 -14 0\nv 14 -14 7\nv 10 -14 7\nf 1 2 3 4\n"
               "v 14 -14.2 0\nv 10 -14.2 0\nv 10 -14.2 7\nv 14 -14.2 7\nf 5 6 7 8\n"
               "o screen\nusemtl screen\n"
               "v 16 -30 0\nv 16 10 0\nv 16 10 20\nv 16 -30 20\nf 9 10 11 12\n"
               "o wall\nusemtl wall\nv 5 -20 0\nv 5 -8 0\nv 5 -8 9\nv 5 -20 9\nf 13 14 15 16\n");
  const auto mirrored = [&](const std::string& intervals) {
    folder.write(
        intervals + ".yaml",
        "format: sunload-study-1\nname: " + intervals +
            "\nsite: {latitude_deg: 48.13, longitude_deg: 11.7, timezone: Europe/Berlin}\n"
            "period: {days: [2026-06-21], from: \"06:00\", to: \"06:20\", step_min: 5}\n"
            "light: {source: clear_sky, sky: cie_clear}\n"
            "scene: {files: [slit.obj], materials: {mirror: {diffuse: 0.05, mirror: 0.8}, "
            "screen: {diffuse: 0.1, transmittance: 0.6, sides: two}, wall: {diffuse: 0.5}}}\n"
            "mesh: {oracle: none, max_edge_m: 2}\n"
            "solver: {year: each, mirror_depth: 1, direct_samples: 256, short_intervals: " +
            intervals + "}\noutput: {series_step: 20 min}\n");
    const Ran ran = program(folder, {"run", intervals + ".yaml"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    const ResultReader result(folder / ("results/" + intervals + "/baseline.h5"));
    return total_of(result.doubles("light_load_mirror"), result.doubles("patch_area"));
  };
  const double each = mirrored("each"), together = mirrored("together");
  EXPECT_GT(each, 0);
  EXPECT_NEAR(together / each, 1, 0.1);  // of some hundred rays through the slit
}

TEST(ShortIntervals, TogetherAreServedByFewSolutions) {
  const WorkFolder folder;
  const auto week = [&](const std::string& name, const std::string& year) {
    std::string study = day_of(name, ", short_intervals: together, year: " + year);
    study.replace(study.find("end: 2026-06-22, step_min: 5"), 28, "end: 2026-06-28, step_min: 10");
    study.replace(study.find("batch_suns: 4"), 13, "batch_suns: 64");
    return result_of_run(folder, name, study);
  };
  const ResultReader each(week("each", "each")), modes(week("modes", "modes"));
  EXPECT_GT(modes.number_attribute("year_suns"), 0);
  const auto area = each.doubles("patch_area");
  for (const char* part : {"light_load_direct", "sun_hours"})
    EXPECT_EQ(each.doubles(part), modes.doubles(part)) << part;
  // Nodes have all suns of their hours, as the hours between them have.
  for (const char* part : {"light_load_reflected", "light_load_sky"}) {
    const auto a = each.doubles(part), b = modes.doubles(part);
    EXPECT_NEAR(total_of(b, area) / total_of(a, area), 1, 5e-3) << part;
    double squares = 0, mean = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      squares += std::pow(b[i] - a[i], 2) / static_cast<double>(a.size());
      mean += a[i] / static_cast<double>(a.size());
    }
    EXPECT_LT(std::sqrt(squares), 0.02 * mean) << part;
  }
}

TEST(ShortIntervals, AreTheSameBitsInShardsAndByThreads) {
  const WorkFolder folder;
  const std::string study = day_of("together", ", short_intervals: together");
  const std::string whole = result_of_run(folder, "together", study, {"--threads", "1"});
  const WorkFolder other;
  result_of_run(other, "together", study, {"--threads", "3", "--shard", "1/2", "--resume"});
  result_of_run(other, "together", study, {"--threads", "2", "--shard", "0/2", "--resume"});
  EXPECT_EQ(different_data(whole, other / "results/together/baseline.h5"),
            std::vector<std::string>{});
}

TEST(ShortIntervals, NoIntervalDependsOnThoseBesideIt) {
  // The last hour of each day has one interval, and is not joined.
  const auto values = [](const std::string& batch) {
    const WorkFolder folder;
    std::string study = day_of("t", ", short_intervals: together", "series: none");
    study.replace(study.find("start: 2026-06-21, end: 2026-06-22, step_min: 5"), 47,
                  "days: [2026-06-21, 2026-06-22], from: \"16:00\", to: \"19:05\", step_min: 5");
    study.replace(study.find("batch_suns: 4"), 13, "batch_suns: " + batch);
    const ResultReader result(result_of_run(folder, "t", study));
    return std::pair(result.doubles("irradiance_max"), result.doubles("light_load_direct"));
  };
  const auto one = values("1"), all = values("16");
  // Suns of a block share samples of the sky about them: as surely, but not the same.
  constexpr double of_samples = 0.03;  // noise of these in half-hidden patches
  for (std::size_t i = 0; i < one.first.size(); ++i)
    EXPECT_NEAR(one.first[i], all.first[i], of_samples * one.first[i]);
  for (std::size_t i = 0; i < one.second.size(); ++i)
    EXPECT_NEAR(one.second[i], all.second[i], 1e-12 * one.second[i]);
}

TEST(ShortIntervals, AreRefusedWhereEachIsAskedFor) {
  const WorkFolder folder;
  folder.write("square.obj", square_obj);
  const auto refused = [&](const std::string& solver, const std::string& output) {
    folder.write("t.yaml", day_of("t", ", short_intervals: together" + solver, output));
    const Ran ran = program(folder, {"check", "t.yaml"});
    EXPECT_EQ(ran.code, 2) << ran.out;
    return ran.err;
  };
  EXPECT_NE(refused("", "series: [total]").find("each of them is stored"), std::string::npos);
  EXPECT_NE(refused(", transport: shoot", "series: none").find("transport: gather"),
            std::string::npos);
  EXPECT_NE(refused("", "series: none, standard_error: instants").find("totals"),
            std::string::npos);
  EXPECT_NE(refused(", accuracy: {irradiance_relative: 0.1}", "series: none").find("every instant"),
            std::string::npos);
  EXPECT_NE(refused("", "series: none}\nmeasures: {bright: {rule: light_hours, above_w_m2: 100}")
                .find("looks at the light of every interval"),
            std::string::npos);
}

}  // namespace
}  // namespace sunload::test
