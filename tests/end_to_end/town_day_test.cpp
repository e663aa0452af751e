// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Studies of cities on a map, as they are shipped: a town of our own, and a real quarter on
/// coarser patches.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "io/result/reader.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/real_models.h"
#include "tests/support/result_check.h"

namespace sunload::test {
namespace {

/// configs/NAME.yaml with another place of its model and patches of at most `max_edge_m`: at 2 m
/// Delft has 680 000 patches and needs two minutes and 3.7 GB.
std::string coarser_study(const std::string& name, const std::string& model,
                          const std::string& path, const std::string& max_edge_m) {
  std::string study = bytes_of(source_folder() + "/configs/" + name + ".yaml");
  const auto change = [&](const std::string& from, const std::string& to) {
    const auto at = study.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    study.replace(at, from.size(), to);
  };
  change(model, path);
  change("max_edge_m: 2", "max_edge_m: " + max_edge_m);
  return study + "solver: {lines_per_patch: 64, realizations: 16}\n";
}

struct Place {
  double latitude_deg = 0, longitude_deg = 0;
  std::size_t objects = 0;
  double longest_day_h = 0;
};

void expect_day(const std::string& study_text, const Place& place) {
  const WorkFolder folder;
  folder.write("day.yaml", study_text);
  const Ran ran = program(folder, {"run", "day.yaml", "--output", "all"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const auto content = folder.content("all");
  const auto found = std::find_if(content.begin(), content.end(),
                                  [](const auto& name) { return name.ends_with("baseline.h5"); });
  ASSERT_NE(found, content.end());
  const std::string path = folder / ("all/" + *found);
  const ResultReader result(path);
  const Energy energy = energy_of(path);
  std::printf("%zu patches, %.1f s, residual %.3g +- %.2g of %.6g kWh\n",
              result.shape("patch_area").at(0), ran.seconds, energy.residual, energy.residual_se,
              energy.in);
  EXPECT_EQ(ledger_problem(path), "");
  EXPECT_EQ(sums_problem(path), "");
  EXPECT_EQ(result.shape("irradiance").at(0), 96u);
  EXPECT_EQ(result.shape("object_name").at(0), place.objects);
  // Position and north come from the projection that the file names.
  EXPECT_NEAR(result.number_attribute("latitude_deg"), place.latitude_deg, 0.01);
  EXPECT_NEAR(result.number_attribute("longitude_deg"), place.longitude_deg, 0.01);
  // On the longest day the sun stands 90° - latitude + 23.44° high.
  const auto elevation = result.doubles("sun_elevation");
  EXPECT_NEAR(*std::max_element(elevation.begin(), elevation.end()),
              90 - place.latitude_deg + 23.44, 0.1);
  const auto hours = result.doubles("sun_hours");
  EXPECT_NEAR(*std::max_element(hours.begin(), hours.end()), place.longest_day_h, 0.3);
}

TEST(CityDay, TownRunsInQuartersOfAnHour) {
  const std::string model = "models/town.city.json";
  // 42 buildings and 8 trees and their ground; 16 h 20 min of sun.
  expect_day(coarser_study("town_day", model, source_folder() + "/configs/" + model, "6"),
             {49.748, 13.377, 51, 16.3});
}

TEST(CityDay, DelftRunsInQuartersOfAnHour) {
  const std::string city = "data/city/delft_lod1_v20.city.json";
  SUNLOAD_NEEDS_MODEL(city);
  // 570 buildings and their ground; 16 h 45 min of sun.
  expect_day(coarser_study("delft_day", "models/delft_lod1_v20.city.json", shared_path(city), "12"),
             {52.01, 4.37, 571, 16.75});
}

}  // namespace
}  // namespace sunload::test
