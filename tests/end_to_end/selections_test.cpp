// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Selections of a study in results, tables and comparisons.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "io/base/statistics.h"
#include "io/result/reader.h"
#include "tests/support/program.h"
#include "tests/support/result_check.h"
#include "tests/support/small_study.h"

namespace sunload::test {
namespace {

const std::string selections =
    "selections:\n"
    "  upper: {object: house, surface: wall, height_m: [3, 8]}\n"
    "  front: {object: house, azimuth_deg: [135, 225]}\n"
    "  nothing: {object: house, surface: window}\n"
    "measures: {sky: {rule: bre_209_vsc, of: {selection: upper}}}\n"
    "variants:\n  - {name: base}\n"
    "  - {name: dark, scene: {assign: [{selection: front, material: paving}]}}\n";
constexpr const char* base = "results/square/base.h5";
constexpr double rounding = 1e-12;  // of sums of some hundred doubles

class Selections : public testing::Test {
 protected:
  Selections() {
    folder_.write("square.obj", square_obj);
    folder_.write("square.yaml", square_study() + selections);
  }
  Ran run(const std::vector<std::string>& words) const { return program(folder_, words); }
  WorkFolder folder_;
};

TEST_F(Selections, AreInResultsTablesAndComparisons) {
  const Ran ran = run({"run", "square.yaml"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_NE(ran.err.find("selection 'nothing' chooses no patch"), std::string::npos) << ran.err;

  const ResultReader result(folder_ / base);
  ASSERT_EQ(result.strings("selection_name"),
            (std::vector<std::string>{"upper", "front", "nothing"}));
  EXPECT_EQ(sums_problem(folder_ / base), "");
  const auto flags = result.doubles("patch_selected"), area = result.doubles("patch_area"),
             load = result.doubles("light_load"),
             of_selection = result.doubles("selection_light_load"),
             centroid = result.doubles("patch_centroid"), sky = result.doubles("measure_sky");
  const std::size_t n = area.size();
  double sum = 0, whole = 0;
  for (std::size_t i = 0; i < n; ++i) {
    sum += flags[i] * area[i] * load[i];
    whole += flags[i] * area[i];
    EXPECT_TRUE(flags[i] == 0 || centroid[3 * i + 2] >= 3.01 - 1e-6) << "3 m above its foot";
    EXPECT_EQ(std::isnan(sky[i]), flags[i] == 0) << "measured is what is selected";
  }
  EXPECT_GT(whole, 0);
  EXPECT_NEAR(result.doubles("selection_area")[0], whole, rounding * whole);
  EXPECT_NEAR(of_selection[0], sum / whole, rounding * sum);
  EXPECT_TRUE(std::isnan(of_selection[2]));
  const auto realizations = result.doubles("selection_light_load_realization");
  std::vector<double> upper;
  for (std::size_t k = 0; k < realizations.size(); k += 3) upper.push_back(realizations[k]);
  EXPECT_NEAR(result.doubles("selection_light_load_se")[0], sample_mean(upper).se, rounding);

  const auto table = nlohmann::json::parse(run({"info", base, "--selections", "--json"}).out);
  ASSERT_EQ(table["rows"].size(), 2u) << "nothing has no area";
  EXPECT_NEAR(table["rows"][0]["light_load_kwh_m2"].get<double>(), of_selection[0],
              rounding * of_selection[0]);
  EXPECT_NE(run({"info", base, "--measures", "--selection", "upper"}).out.find("upper"),
            std::string::npos);
  const Ran unknown = run({"info", base, "--selection", "uper"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.err.find("'upper'"), std::string::npos) << unknown.err;

  const auto compared = nlohmann::json::parse(
      run({"compare", base, "results/square/dark.h5", "--storey-m", "3.5", "--json"}).out);
  std::map<std::string, std::set<std::string>> names;
  for (const auto& row : compared["rows"]) {
    names[row["group"]].insert(row["name"].get<std::string>());
    if (row["group"] != "selection" || row["name"] != "front") continue;
    EXPECT_NEAR(row["base_kwh_m2"].get<double>(), of_selection[1], rounding * of_selection[1]);
  }
  EXPECT_EQ(names["selection"], (std::set<std::string>{"upper", "front"}));
  EXPECT_EQ(names["orientation"], (std::set<std::string>{"north", "east", "south", "west"}));
  EXPECT_EQ(names["storey"], (std::set<std::string>{"0-3.5 m", "3.5-7 m"}));
}

TEST_F(Selections, CheckTellsWhatTheyChoose) {
  const Ran ran = run({"check", "square.yaml"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_NE(ran.out.find("  upper: "), std::string::npos) << ran.out;
  EXPECT_NE(ran.out.find("  sky: bre_209_vsc of "), std::string::npos) << ran.out;
  EXPECT_NE((ran.out + ran.err).find("selection 'nothing' chooses no patch"), std::string::npos);
}

}  // namespace
}  // namespace sunload::test
