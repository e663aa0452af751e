// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A clear day in a street: what each patch receives at every instant, to 5 %.
#include <gtest/gtest.h>

#include <iostream>

#include "io/result/reader.h"
#include "tests/support/program.h"
#include "tests/support/small_study.h"

namespace sunload::test {
namespace {

constexpr double goal = 0.05, share_of_mean_that_counts = 0.05;

/// Of all pairs of patches and suns with at least a twentieth of the instant's mean irradiance
/// those whose standard error is within the goal.
double share_within_goal(const std::string& accuracy) {
  const WorkFolder folder;
  std::string study = street_study("instants", accuracy);
  const std::string few = "lines_per_patch: 64, direct_samples: 16, realizations: 16";
  study.replace(study.find(few), few.size(),
                "lines_per_patch: 256, direct_samples: 16, realizations: 8");
  folder.write("street.yaml", study);
  EXPECT_EQ(program(folder, {"run", "street.yaml", "--output", "out"}).code, 0);
  const ResultReader result(folder / "out/street/baseline.h5");
  const auto E = result.doubles("irradiance"), se = result.doubles("irradiance_se");
  const auto area = result.doubles("patch_area");
  double pairs = 0, within = 0;
  for (std::size_t begin = 0; begin < E.size(); begin += area.size()) {
    double power = 0, all = 0;
    for (std::size_t i = 0; i < area.size(); ++i) power += E[begin + i] * area[i], all += area[i];
    for (std::size_t i = begin; i < begin + area.size(); ++i) {
      if (E[i] <= 0 || E[i] < share_of_mean_that_counts * power / all) continue;
      ++pairs;
      if (se[i] <= goal * E[i]) ++within;
    }
  }
  std::cout << (accuracy.empty() ? "256 lines" : accuracy) << ": " << within / pairs
            << " of patches and suns\n";
  return within / pairs;
}

TEST(ClearSky, SeriesHaveTheErrorThatIsAskedFor) {
  EXPECT_GE(share_within_goal(", accuracy: {irradiance_relative: 0.05}"), 0.95);
  // Planted fault: the same for all patches.
  EXPECT_LT(share_within_goal(""), 0.95);
}

}  // namespace
}  // namespace sunload::test
