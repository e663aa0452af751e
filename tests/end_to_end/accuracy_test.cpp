// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Studies that ask for an accuracy: counts are decided once, told, stored, and the same for
/// every shard.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "io/result/reader.h"
#include "tests/support/program.h"
#include "tests/support/result_check.h"
#include "tests/support/small_study.h"
#include "tests/support/square_folder.h"

namespace sunload::test {
namespace {

struct AccurateSquare : SquareFolder {
  explicit AccurateSquare(const std::string& solver, const std::string& max_edge_m = "1.5")
      : SquareFolder(square_study("totals", solver, max_edge_m)) {}
};

TEST(AccuracyStudy, DecidesCountsOnceForThreadsAndShards) {
  const AccurateSquare square(", accuracy: {light_load_relative: 0.02}, max_lines_per_patch: 8192");
  const Ran check = program(square.folder, {"check", "square.yaml"});
  EXPECT_NE(check.out.find("counts are decided at the start of the run"), std::string::npos)
      << check.out;
  const Ran ran = square.run("one", {"--threads", "1"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_NE(ran.err.find("accuracy of 2 %"), std::string::npos) << ran.err;
  const ResultReader result(square.result("one"));
  const double lines = result.number_attribute("lines_per_patch");
  EXPECT_GT(lines, 64);
  EXPECT_LE(lines, 8192);
  const auto of_patch = result.doubles("patch_lines");
  const double sum = std::accumulate(of_patch.begin(), of_patch.end(), 0.0);
  EXPECT_NEAR(sum / static_cast<double>(of_patch.size()), lines, 0.5);
  EXPECT_LT(*std::min_element(of_patch.begin(), of_patch.end()),
            *std::max_element(of_patch.begin(), of_patch.end()));
  EXPECT_GE(result.number_attribute("direct_samples"), 16);
  EXPECT_EQ(result.number_attribute("accuracy_light_load_relative"), 0.02);
  EXPECT_GE(result.number_attribute("accuracy_area_share"), 0.9);
  const Ran info = program(square.folder, {"info", square.result("one")});
  EXPECT_NE(info.out.find("asked for: below 2 % on 95 % of the area"), std::string::npos)
      << info.out;
  for (const char* shard : {"1/2", "0/2"})
    ASSERT_EQ(square.run("shards", {"--shard", shard, "--threads", "3"}).code, 0);
  EXPECT_EQ(different_data(square.result("one"), square.result("shards")),
            std::vector<std::string>{});
  EXPECT_EQ(ResultReader(square.result("shards")).number_attribute("lines_per_patch"), lines);
  EXPECT_EQ(ledger_problem(square.result("one")), "");
}

TEST(AccuracyStudy, MeetsAGoalAtEveryInstant) {
  const std::string goal = ", accuracy: {irradiance_relative: 0.06}, max_lines_per_patch: 8192";
  for (const std::string transport : {"gather", "shoot"}) {
    const AccurateSquare square(goal + ", transport: " + transport, "4");
    square.folder.write("square.yaml",
                        square_study("instants", goal + ", transport: " + transport, "4"));
    const Ran ran = square.run("one", {"--threads", "1"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_NE(ran.err.find("accuracy of 6 % at every instant"), std::string::npos) << ran.err;
    const ResultReader result(square.result("one"));
    EXPECT_EQ(result.number_attribute("accuracy_irradiance_relative"), 0.06);
    EXPECT_GE(result.number_attribute("accuracy_irradiance_share"), 0.95);
    EXPECT_TRUE(std::isnan(result.number_attribute("accuracy_area_share")));
    const Ran info = program(square.folder, {"info", square.result("one")});
    EXPECT_NE(info.out.find("asked for: below 6 % at every instant on 95 % of the area; reached"),
              std::string::npos)
        << info.out;
    for (const char* shard : {"1/2", "0/2"})
      ASSERT_EQ(square.run("shards", {"--shard", shard, "--threads", "3"}).code, 0);
    EXPECT_EQ(different_data(square.result("one"), square.result("shards")),
              std::vector<std::string>{});
    EXPECT_EQ(ledger_problem(square.result("one")), "");
  }
  // Planted fault: the same counts for all patches, and no more than at first.
  const AccurateSquare square("", "4");
  square.folder.write("square.yaml", square_study("instants", "", "4"));
  ASSERT_EQ(square.run("few").code, 0);
  const ResultReader few(square.result("few"));
  const auto E = few.doubles("irradiance"), se = few.doubles("irradiance_se");
  std::size_t lit = 0, kept = 0;
  for (std::size_t at = 0; at < E.size(); ++at) {
    if (E[at] < 10) continue;
    ++lit;
    if (se[at] <= 0.06 * E[at]) ++kept;
  }
  EXPECT_LT(static_cast<double>(kept), 0.95 * static_cast<double>(lit));
}

TEST(AccuracyStudy, PairsVariantsWhoseCountsDiffer) {
  const AccurateSquare square("", "4");
  square.folder.write("square.yaml",
                      square_study("totals", ", accuracy: {light_load_relative: 0.05}", "4") +
                          "variants:\n"
                          "  - {name: baseline}\n"
                          "  - {name: pale, scene: {materials: {paving: {diffuse: 0.7}}}}\n");
  const Ran ran = square.run("one");
  ASSERT_EQ(ran.code, 0) << ran.err;
  const std::string base = square.result("one"), pale = square.folder / "one/square/pale.h5";
  EXPECT_NE(ResultReader(base).doubles("patch_lines"), ResultReader(pale).doubles("patch_lines"));
  const Ran compared = program(square.folder, {"compare", base, pale});
  EXPECT_EQ(compared.code, 0) << compared.err;
  EXPECT_NE(compared.out.find("standard errors of paired differences"), std::string::npos)
      << compared.out;
}

TEST(AccuracyStudy, NeedsAGoal) {
  const AccurateSquare square(", accuracy: {}");
  const Ran check = program(square.folder, {"check", "square.yaml"});
  EXPECT_EQ(check.code, 2);
  EXPECT_NE(check.err.find("solver.accuracy.light_load_relative is missing"), std::string::npos)
      << check.err;
  EXPECT_NE(check.err.find("or irradiance_relative"), std::string::npos) << check.err;
}

TEST(AccuracyStudy, DecidesWhatIsShot) {
  for (const std::string power : {"auto", "100"}) {
    const AccurateSquare square(
        ", accuracy: {light_load_relative: 0.03}, max_lines_per_patch: 8192, "
        "transport: shoot, power_per_sample_w: " +
            power,
        "4");
    const Ran ran = square.run("one", {"--threads", "1"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_NE(ran.err.find(power == "auto" ? "in the first shot" : "W per sample"),
              std::string::npos)
        << ran.err;
    const ResultReader result(square.result("one"));
    EXPECT_GT(result.number_attribute("samples_per_patch"), 64);
    EXPECT_GE(result.number_attribute("accuracy_area_share"), 0.9);
    EXPECT_EQ(ledger_problem(square.result("one")), "");
    if (power != "auto") continue;
    for (const char* shard : {"1/2", "0/2"})
      ASSERT_EQ(square.run("shards", {"--shard", shard, "--threads", "3"}).code, 0);
    EXPECT_EQ(different_data(square.result("one"), square.result("shards")),
              std::vector<std::string>{});
  }
}

TEST(AccuracyStudy, SaysWhereTheMostIsTooLittle) {
  const AccurateSquare square(", accuracy: {light_load_relative: 0.001}, max_lines_per_patch: 128");
  const Ran ran = square.run("a");
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_NE(ran.err.find("128 lines and samples at most cannot give more (max_lines_per_patch)"),
            std::string::npos)
      << ran.err;
  const ResultReader result(square.result("a"));
  const auto lines = result.doubles("patch_lines");
  EXPECT_EQ(*std::max_element(lines.begin(), lines.end()), 128);
  EXPECT_LT(result.number_attribute("accuracy_area_share"), 0.95);
}

}  // namespace
}  // namespace sunload::test
