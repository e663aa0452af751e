// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Means with their errors, and sums of the ledger.

#include "solver/light/tally.h"

#include <gtest/gtest.h>

namespace sunload::test {
namespace {

TEST(MeanError, IsTheStandardErrorOfTheMean) {
  // 1, 2, 3, 4: variance (2.25 + 0.25 + 0.25 + 2.25) / 3 = 5/3.
  const MeanError error = mean_error({1, 2, 3, 4});
  EXPECT_DOUBLE_EQ(error.mean, 2.5);
  EXPECT_DOUBLE_EQ(error.standard_error, std::sqrt(5.0 / 3 / 4));
}

TEST(MeanError, OfOneValueIsUnknownAndGivenAsZero) {
  EXPECT_EQ(mean_error({7}).mean, 7);
  EXPECT_EQ(mean_error({7}).standard_error, 0);
}

TEST(MeanError, KeepsItsDigitsOnALargeOffset) {
  // Squares would lose all of them: 1e9² has an ulp of 128.
  const MeanError error = mean_error({1e9 + 1, 1e9 + 2, 1e9 + 3, 1e9 + 4});
  EXPECT_NEAR(error.standard_error, std::sqrt(5.0 / 12), 1e-6);
}

TEST(Ledger, ResidualIsInLessOut) {
  Ledger ledger;
  for (std::size_t t = 0; t < term_count; ++t) ledger.terms[t] = static_cast<double>(1u << t);
  EXPECT_EQ(ledger.in(), 1 + 2 + 4 + 8);
  EXPECT_EQ(ledger.out(), 16 + 32 + 64 + 128);
  EXPECT_EQ(ledger.residual(), 15 - 240);
  Ledger twice = ledger;
  twice += ledger;
  EXPECT_EQ(twice[Term::unshot], 256);
  EXPECT_EQ(twice.in(), 30);
}

}  // namespace
}  // namespace sunload::test
