// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The same bits for any number of threads.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "io/result/reader.h"
#include "tests/support/program.h"
#include "tests/support/result_check.h"
#include "tests/support/small_study.h"

namespace sunload::test {
namespace {

/// Result of a study with that number of threads, in a folder of its own.
std::string result_of(const WorkFolder& folder, const std::string& study, int threads) {
  const std::string output = fmt::format("{}_{}", study, threads);
  const Ran ran = program(
      folder, {"run", study + ".yaml", "--threads", std::to_string(threads), "--output", output});
  EXPECT_EQ(ran.code, 0) << ran.err;
  return folder / (output + "/" + study + "/baseline.h5");
}

void expect_same_bits(const WorkFolder& folder, const std::string& study) {
  const std::string one = result_of(folder, study, 1);
  EXPECT_EQ(ledger_problem(one), "");
  // The largest value of each band may come at a time of its own.
  if (ResultReader(one).bands() == Bands::broadband) {
    EXPECT_EQ(sums_problem(one), "");
  }
  for (const int threads : {2, 3})
    EXPECT_EQ(different_data(one, result_of(folder, study, threads)), std::vector<std::string>{})
        << threads << " threads";
}

TEST(SameBits, StreetWithErrorsOfTotals) {
  const WorkFolder folder;
  folder.write("street.yaml", street_study("totals"));
  expect_same_bits(folder, "street");
}

TEST(SameBits, StreetWithErrorsOfInstants) {
  const WorkFolder folder;
  folder.write("street.yaml", street_study("instants"));
  expect_same_bits(folder, "street");
}

TEST(SameBits, SeveralSunsOfAnIntervalByBothTransports) {
  for (const char* transport : {"gather", "shoot"}) {
    const WorkFolder folder;
    folder.write(
        "street.yaml",
        street_study("instants",
                     std::string(", sun_samples_per_interval: auto, transport: ") + transport));
    expect_same_bits(folder, "street");
  }
}

TEST(SameBits, YearFromFewSolutions) {
  const WorkFolder folder;
  folder.write("square.obj", square_obj);
  for (const char* bands : {"broadband", "rgb"}) {
    folder.write("square.yaml",
                 square_in_five_minutes(std::string(", year: modes, bands: ") + bands));
    expect_same_bits(folder, "square");
    for (const char* threads : {"1", "2", "3"})
      std::filesystem::remove_all(folder / (std::string("square_") + threads));
  }
}

TEST(SameBits, MirrorsLampsAndTwoSidedSheets) {
  const WorkFolder folder;
  folder.write("square.obj", square_obj);
  for (const char* errors : {"totals", "instants"}) {
    folder.write("square.yaml", square_study(errors));
    expect_same_bits(folder, "square");
    std::filesystem::remove_all(folder / "square_1");
    std::filesystem::remove_all(folder / "square_2");
    std::filesystem::remove_all(folder / "square_3");
  }
}

// The twins: what must be found different is.

TEST(SameBits, AnotherSeedIsNoticed) {
  const WorkFolder folder;
  folder.write("square.obj", square_obj);
  folder.write("square.yaml", square_study());
  const std::string one = result_of(folder, "square", 1);
  folder.write("square.yaml", square_study("totals", ", seed: 2"));
  const auto different = different_data(one, result_of(folder, "square", 2));
  for (const char* name : {"irradiance", "light_load", "light_load_se", "power_residual"})
    EXPECT_NE(std::find(different.begin(), different.end(), name), different.end()) << name;
  EXPECT_EQ(std::find(different.begin(), different.end(), "patch_area"), different.end());
}

TEST(SameBits, LostEnergyIsNoticed) {
  const WorkFolder folder;
  folder.write("street.yaml", street_study());
  EXPECT_NE(ledger_problem(result_of(folder, "street", 2), 0.01), "");
}

}  // namespace
}  // namespace sunload::test
