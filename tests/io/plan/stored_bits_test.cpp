// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/stored_bits.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sunload::test {
namespace {

Study with_lines(int lines) {
  Study study;
  study.solver.lines_per_patch = lines;
  study.output.significant_bits = std::nullopt;
  return study;
}

TEST(StoredBits, AreAllUnlessAskedFor) {
  EXPECT_EQ(stored_bits({}), float_mantissa_bits);
  Study study;
  study.output.significant_bits = 7;
  EXPECT_EQ(stored_bits(study), 7);
}

TEST(StoredBits, AutoKeepsTheFewestThatTheErrorOfLinesAllows) {
  for (const int lines : {1, 8, 64, 256, 1024, 4096, 1'000'000}) {
    const int bits = stored_bits(with_lines(lines));
    const double tolerable = 0.1 * std::pow(lines, -0.75);
    EXPECT_LE(std::exp2(-(bits + 1)), tolerable) << lines;
    EXPECT_GT(std::exp2(-bits), tolerable) << lines << ": one bit less would do";
  }
  EXPECT_EQ(stored_bits(with_lines(256)), 9);
}

TEST(StoredBits, AutoKnowsThatAnAccuracyMayRaiseTheLines) {
  Study study = with_lines(256);
  study.solver.accuracy = AccuracyStudy{};
  study.solver.max_lines_per_patch = 4096;
  EXPECT_EQ(stored_bits(study), stored_bits(with_lines(4096)));
}

}  // namespace
}  // namespace sunload::test
