// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Materials of all kinds in whole runs: panes, metal, glossy surfaces, crowns.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "io/result/reader.h"
#include "tests/support/program.h"
#include "tests/support/real_models.h"
#include "tests/support/reference.h"
#include "tests/support/result_check.h"
#include "tests/support/small_study.h"

namespace sunload::test {
namespace {

/// The square with other materials.
std::string study_with(const std::string& glass, const std::string& canvas) {
  std::string study = square_study("totals", ", bounces: 20");
  const auto put = [&](const std::string& old, const std::string& now) {
    study.replace(study.find(old), old.size(), now);
  };
  put("glass: {diffuse: 0.05, mirror: 0.85}", "glass: {" + glass + "}");
  put("canvas: {diffuse: 0.5, sides: two}", "canvas: {" + canvas + "}");
  return study;
}

double sum_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(Materials, EveryKindBalances) {
  const std::pair<const char*, const char*> kinds[] = {
      {"refractive_index: 1.52, panes: 2, absorption_per_m: 10", "diffuse: 0.5, sides: two"},
      {"refractive_index: 1.52, diffuse: 0.2", "refractive_index: 1.52, sides: two"},
      {"refractive_index: 1.44, extinction_coefficient: 5.23",
       "diffuse: 0.2, transmittance: 0.4, sides: two"},
      {"normal_transmittance: 0.78, mirror: 0.14, diffuse: 0.02",
       "normal_transmittance: 0.9, sides: two"},
      {"diffuse: 0.1, glossy: 0.6, glossy_exponent: 40",
       "diffuse: 0.2, transmittance: 0.4, mirror: 0.1, sides: two"}};
  for (const auto& [glass, canvas] : kinds) {
    const WorkFolder folder;
    folder.write("square.obj", square_obj);
    folder.write("square.yaml", study_with(glass, canvas));
    const Ran ran = program(folder, {"run", "square.yaml"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const std::string path = folder / "results/square/baseline.h5";
    EXPECT_EQ(ledger_problem(path), "") << glass;
    EXPECT_NE(ledger_problem(path, 0.05), "") << glass;
    EXPECT_EQ(sums_problem(path), "") << glass;
    const std::string says_of_glass = glass;
    const auto says = [&](const char* words) {
      return says_of_glass.find(words) != std::string::npos;
    };
    const bool has_panes = says("1.52") || says("normal_transmittance");
    EXPECT_EQ(sum_of(ResultReader(path).doubles("power_transmitted")) > 0, has_panes) << glass;
  }
}

TEST(Materials, CheckListsThem) {
  const WorkFolder folder;
  folder.write("square.obj", square_obj);
  folder.write("square.yaml", study_with("refractive_index: 1.52, panes: 2",
                                         "diffuse: 0.2, transmittance: 0.4, sides: two"));
  const Ran ran = program(folder, {"check", "square.yaml"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  for (const char* words :
       {"2 x 4 mm of n 1.52", "mirror 0.151", "transmits 0.849", "passes 0.400"})
    EXPECT_NE(ran.out.find(words), std::string::npos) << words << "\n" << ran.out;
  folder.write("clear.yaml",
               study_with("normal_transmittance: 0.88, mirror: 0.07", "diffuse: 0.2"));
  const Ran clear = program(folder, {"check", "clear.yaml"});
  ASSERT_EQ(clear.code, 0) << clear.err;
  EXPECT_NE(clear.out.find("mirror 0.070  transmits 0.896  clear glass of 0.88"), std::string::npos)
      << clear.out;
}

TEST(Materials, EveryPropertyIsInTheHash) {
  const WorkFolder folder;
  folder.write("square.obj", square_obj);
  std::vector<std::string> hashes;
  for (const char* glass :
       {"refractive_index: 1.52", "refractive_index: 1.53", "refractive_index: 1.52, panes: 2",
        "refractive_index: 1.52, absorption_per_m: 9",
        "refractive_index: 1.52, absorption_per_m: 9, thickness_m: 0.005",
        "refractive_index: 1.52, extinction_coefficient: 2", "glossy: 0.2, glossy_exponent: 2",
        "glossy: 0.2, glossy_exponent: 3", "transmittance: 0.2", "normal_transmittance: 0.2",
        "normal_transmittance: 0.21", "normal_transmittance: 0.21, mirror: 0.1"}) {
    folder.write("square.yaml", study_with(glass, "diffuse: 0.5"));
    const Ran ran = program(folder, {"check", "square.yaml", "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    hashes.push_back(nlohmann::json::parse(ran.out)["variants"][0]["hash"]);
  }
  for (std::size_t i = 0; i < hashes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(hashes[i], hashes[j]) << i << " and " << j;
}

// Share of a year's light on a south window that clear glass transmits, against six building
// simulation programs (ANSI/ASHRAE 140-2020, B8-13 and B8-14): two panes (case 600) and one (670)
// of 3.048 mm, n 1.493, K 33.7 /m.
TEST(Materials, WindowsOfDenverTransmitAsPublished) {
  const std::string table = "07_cie171_bestest/ashrae140_solar_annual.csv";
  const std::string weather = "data/weather/WD100_denver.epw";
  SUNLOAD_NEEDS_MODEL(weather);
  const auto row = [&](const std::string& quantity, const std::string& name) {
    for (const auto& r : read_csv(table))
      if (r.at("quantity").find(quantity) != std::string::npos && r.at("case") == name) return r;
    throw std::runtime_error("no row " + quantity + ", " + name);
  };
  const Row incident = row("annual incident", "South");
  for (const auto& [name, panes] : {std::pair{"600 South", 2}, {"670 South", 1}}) {
    const WorkFolder folder;
    folder.write("window.obj", "o window\nv 0 0 1\nv 3 0 1\nv 3 0 3\nv 0 0 3\nf 1 2 3 4\n");
    folder.write("window.yaml",
                 fmt::format("format: sunload-study-1\nname: window\nsite: {{timezone: UTC}}\n"
                             "period: {{year_of: weather}}\n"
                             "light: {{source: weather, weather: {}}}\n"
                             "scene: {{files: [window.obj], repair: none, materials: {{glass: "
                             "{{refractive_index: 1.493, thickness_m: 0.003048, absorption_per_m: "
                             "33.7, panes: {}}}}}, assign: [{{material: glass}}]}}\n"
                             "solver: {{bounces: 1, lines_per_patch: 16384, direct_samples: 2, "
                             "realizations: 2, batch_suns: 512}}\n",
                             shared_path(weather), panes));
    const Ran ran = program(folder, {"run", "window.yaml"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const ResultReader result(folder / "results/window/baseline.h5");
    constexpr double area_m2 = 6, hours_to_kwh = 1e-3;  // one interval is an hour
    const auto loads = result.doubles("light_load"), areas = result.doubles("patch_area");
    const double received =
        std::inner_product(loads.begin(), loads.end(), areas.begin(), 0.0) / area_m2;
    const double transmitted = sum_of(result.doubles("power_transmitted")) * hours_to_kwh / area_m2;
    const Row published = row("annual transmitted unshaded", name);
    std::vector<double> shares;
    for (const char* program_name : {"BSIMAC", "CSE", "DeST", "EnergyPlus", "ESP-r", "TRNSYS"})
      shares.push_back(number(published, program_name) / number(incident, program_name));
    const auto [least, most] = std::minmax_element(shares.begin(), shares.end());
    fmt::print("  {}: {:.1f} of {:.1f} kWh/m2, share {:.4f}, published {:.4f} to {:.4f}\n", name,
               transmitted, received, transmitted / received, *least, *most);
    const double wider = 0.02 * number(published, "mean") / number(incident, "mean");
    EXPECT_GE(transmitted / received, *least - wider);
    EXPECT_LE(transmitted / received, *most + wider);
  }
}

}  // namespace
}  // namespace sunload::test
