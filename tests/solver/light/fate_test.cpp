// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/light/fate.h"

#include <gtest/gtest.h>

#include "solver/light/tally.h"

namespace sunload::test {
namespace {

constexpr Fate<double> fate{1, 2, 4, 8, 16};

TEST(Fate, EveryKindIsBookedOnce) {
  Ledger before;
  before[Term::absorbed] = 32;
  before[Term::sun] = 63;
  const Ledger ledger = booked(fate, before);
  EXPECT_EQ(ledger[Term::escaped], 1);
  EXPECT_EQ(ledger[Term::absorbed], 32 + 2 + 16);
  EXPECT_EQ(ledger.lost_at_backs, 2);
  EXPECT_EQ(ledger[Term::unshot], 4);
  EXPECT_EQ(ledger[Term::transmitted], 8);
  EXPECT_EQ(ledger.residual(), 0);
}

TEST(Fate, SumsAndMultiples) {
  Fate<double> sum = scaled(fate, 2.0);
  sum += fate;
  EXPECT_EQ(booked(sum).out(), 3 * booked(fate).out());
  EXPECT_EQ(sum.cut, 12);
  EXPECT_EQ(in_double(Fate<float>{1, 2, 4, 8, 16}).transmitted, 8);
}

TEST(Fate, EverySunOfABlockHasItsOwn) {
  SunFates fates;
  double power[block_width] = {};
  power[3] = 5;
  fates.add(fate, power);
  fates += fates;
  EXPECT_EQ(fates[3].absorbed, 160);
  EXPECT_EQ(booked(fates[2]).out(), 0);
}

}  // namespace
}  // namespace sunload::test
