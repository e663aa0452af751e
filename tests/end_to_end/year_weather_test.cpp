// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Few solutions for months of changing weather: parts of the time and parts of the light are those
/// of a solution for each interval.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "io/result/reader.h"
#include "tests/support/program.h"
#include "tests/support/small_weather.h"

namespace sunload::test {
namespace {

/// Some hours clear, some overcast, others between: shares from the digits of a hash.
std::string cloudy_csv() {
  std::string text = "time,dni_w_m2,dhi_w_m2\n";
  std::uint32_t hash = 1;
  each_small_hour({}, [&](const SmallHour& h) {
    hash = hash * 1664525u + 1013904223u;  // Knuth (1973), The art of computer programming 2
    const double cloud = h.ghi == 0 ? 0 : static_cast<double>(hash >> 24) / 255;
    const double dni = h.dni * std::max(0.0, 1 - 1.5 * cloud);
    const double dhi = h.dhi * (1 + 2 * cloud);
    text +=
        fmt::format("2026-{:02}-{:02}T{:02}:00,{:.0f},{:.0f}\n", h.month, h.day, h.hour, dni, dhi);
  });
  return text;
}

std::string year_study(const char* year) {
  return std::string(
             "format: sunload-study-1\n"
             "name: court\n"
             "site: {latitude_deg: 48.13, longitude_deg: 11.7, timezone: Etc/GMT-1, north_deg: "
             "17}\n"
             "period: {start: \"2026-03-01T00:00\", end: \"2026-06-01T00:00\", step_min: 60}\n"
             "light: {source: weather, weather: cloudy.csv, stamp: end, far_ground_albedo: 0.25}\n"
             "scene:\n"
             "  builtin: {name: box_on_plane}\n"
             "  ground: {surface: level, height_m: 0, margin_m: 12, material: concrete}\n"
             "  materials:\n"
             "    light_wall: {diffuse: 0.6}\n"
             "    glass_wall: {refractive_index: 1.52, panes: 2, diffuse: 0.05}\n"
             "  edit:\n"
             "    - {object: \"*\", remove: true}\n"
             "    - {add: {name: a, material: light_wall, footprint: "
             "{polygon: [[0,0],[20,0],[20,6],[7,6],[7,22],[0,22]], height_m: 11, base_m: 0}}}\n"
             "    - {add: {name: g, material: glass_wall, box: {position_m: [14, 20, 0], "
             "size_m: [9, 7, 17], turn_deg: 28}}}\n"
             "mesh: {oracle: none, max_edge_m: 5}\n"
             "solver: {lines_per_patch: 128, direct_samples: 16, realizations: 16, bounces: 4, "
             "year: ") +
         year +
         "}\n"
         "output: {folder: results, totals: [hour_of_day], series: none}\n";
}

/// What `modes` differ by from `each`, in standard errors of `each`, of every value that has one.
std::vector<double> differences(const std::vector<double>& modes, const std::vector<double>& each,
                                const std::vector<double>& se) {
  std::vector<double> shares;
  for (std::size_t i = 0; i < each.size(); ++i)
    if (se[i] > 0) shares.push_back((modes[i] - each[i]) / se[i]);
  return shares;
}

double root_mean_square(const std::vector<double>& values) {
  double sum = 0;
  for (const double x : values) sum += x * x;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double x : values) most = std::max(most, std::abs(x));
  return most;
}

// Lines are those of `each`, and with them the noise: what is left is what few solutions are off
// by, and samples of the sky about the sun.
TEST(YearOfWeather, HoursOfFacadesAndPartsOfTheLightAreThoseOfEachInterval) {
  const WorkFolder folder;
  folder.write("cloudy.csv", cloudy_csv());
  for (const char* year : {"modes", "each"}) {
    folder.write("court.yaml", year_study(year));
    const Ran ran = program(folder, {"run", "court.yaml", "--output", year});
    ASSERT_EQ(ran.code, 0) << ran.err;
  }
  const ResultReader modes(folder / "modes/court/baseline.h5"),
      each(folder / "each/court/baseline.h5");
  const auto off = [&](const std::string& name) {
    return differences(modes.doubles(name), each.doubles(name), each.doubles(name + "_se"));
  };
  const auto hours = off("facade_light_load_by_hour_of_day");
  ASSERT_GT(hours.size(), 100u);
  // A third of an error is what the period's own test allows for intervals.
  EXPECT_LT(root_mean_square(hours), 1.0 / 3);
  EXPECT_LT(largest(hours), 1);
  for (const char* name : {"facade_light_load", "light_load", "light_load_reflected",
                           "light_load_sky", "light_load_by_hour_of_day"})
    EXPECT_LT(root_mean_square(off(name)), 1.0 / 3) << name;
}

}  // namespace
}  // namespace sunload::test
