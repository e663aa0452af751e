// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A day of a real quarter: the study that is shipped, on coarser patches.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "io/result/reader.h"
#include "tests/support/paths.h"
#include "tests/support/program.h"
#include "tests/support/real_models.h"
#include "tests/support/result_check.h"

namespace sunload::test {
namespace {

/// configs/delft_day.yaml with another city file's place and patches of at most
/// `max_edge_m`: at 2 m it has 680 000 patches and needs two minutes and 3.7 GB.
std::string coarser_study(const std::string& city, const std::string& max_edge_m) {
  std::ostringstream text;
  text << std::ifstream(test::source_folder() + "/configs/delft_day.yaml").rdbuf();
  std::string study = text.str();
  const auto change = [&](const std::string& from, const std::string& to) {
    const auto at = study.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    study.replace(at, from.size(), to);
  };
  change("../../shared/data/city/delft_lod1_v20.city.json", city);
  change("max_edge_m: 2", "max_edge_m: " + max_edge_m);
  return study + "solver: {lines_per_patch: 64, realizations: 16}\n";
}

TEST(DelftDay, RunsInQuartersOfAnHour) {
  const std::string city = "data/city/delft_lod1_v20.city.json";
  SUNLOAD_NEEDS_MODEL(city);
  const WorkFolder folder;
  folder.write("delft_day.yaml", coarser_study(shared_path(city), "12"));
  const Ran ran = program(folder, {"run", "delft_day.yaml"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const std::string path = folder / "results/delft_day/baseline.h5";
  const ResultReader result(path);
  const Energy energy = energy_of(path);
  std::printf("%zu patches, %.1f s, residual %.3g +- %.2g of %.6g kWh\n",
              result.shape("patch_area").at(0), ran.seconds, energy.residual, energy.residual_se,
              energy.in);
  EXPECT_EQ(ledger_problem(path), "");
  EXPECT_EQ(sums_problem(path), "");
  EXPECT_EQ(result.shape("irradiance").at(0), 96u);
  EXPECT_EQ(result.shape("object_name").at(0), 571u);  // 570 buildings and their ground
  // Position and north come from the projection that the file names (Delft, Rijksdriehoek).
  EXPECT_NEAR(result.number_attribute("latitude_deg"), 52.01, 0.01);
  EXPECT_NEAR(result.number_attribute("longitude_deg"), 4.37, 0.01);
  // On the longest day the sun stands 90° - 52.01° + 23.44° high.
  const auto elevation = result.doubles("sun_elevation");
  EXPECT_NEAR(*std::max_element(elevation.begin(), elevation.end()), 61.43, 0.1);
  // The sun is above the horizon for 16 h 45 min.
  const auto hours = result.doubles("sun_hours");
  EXPECT_NEAR(*std::max_element(hours.begin(), hours.end()), 16.75, 0.3);
}

}  // namespace
}  // namespace sunload::test
