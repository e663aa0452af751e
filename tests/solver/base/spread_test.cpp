// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/base/spread.h"

#include <gtest/gtest.h>

#include <array>

namespace sunload::test {
namespace {

constexpr std::array<double, 4> values{1, 2, 3, 4};
double value(std::size_t r) { return values[r]; }

TEST(Spread, OfFourValues) {
  EXPECT_EQ(mean_of(4, value), 2.5);
  EXPECT_DOUBLE_EQ(variance_of(4, value), 5.0 / 3);
  EXPECT_DOUBLE_EQ(standard_error(5.0 / 3, 4), std::sqrt(5.0 / 12));
}

TEST(Spread, BySumsIsTheSame) {
  EXPECT_DOUBLE_EQ(variance_by_sums(4, 10, 30), variance_of(4, value));
  // Rounding may leave less than nothing.
  EXPECT_EQ(variance_by_sums(2, 2, 2 - 1e-15), 0);
}

TEST(Spread, OneValueHasNone) {
  EXPECT_EQ(mean_of(1, value), 1);
  EXPECT_EQ(variance_of(1, value), 0);
  EXPECT_EQ(variance_by_sums(1, 3, 9), 0);
  EXPECT_EQ(standard_error(0, 1), 0);
}

TEST(Spread, IsTakenAboutTheMean) {
  EXPECT_DOUBLE_EQ(variance_of(4, [](std::size_t r) { return 1e9 + value(r); }), 5.0 / 3);
}

}  // namespace
}  // namespace sunload::test
