// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Samples of a shot: their shares, their number, and who must have one.
#include "solver/shoot/shot_power.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "geo/base/check.h"

namespace sunload {
namespace {

double all(const std::vector<std::uint32_t>& counts) {
  return std::accumulate(counts.begin(), counts.end(), 0.0);
}

/// Two suns: the first lights all patches by their number, the second the last one, faintly.
DoubleColumns two_suns(std::size_t patches) {
  DoubleColumns power = double_columns(patches);
  for (std::size_t i = 0; i < patches; ++i) power[i * block_width] = static_cast<double>(i);
  power[(patches - 1) * block_width + 1] = 1e-6;
  return power;
}

TEST(SampleCounts, AreTheRequestedNumberWhereNoneIsRaisedToOne) {
  DoubleColumns power = double_columns(7);
  for (std::size_t i = 0; i < 7; ++i) power[i * block_width + 3] = 1 + static_cast<double>(i);
  const auto total = total_power(power);
  EXPECT_EQ(total[3], 28);
  for (const double samples : {28.0, 100.0, 12345.6})
    for (const double offset : {0.0, 0.37, 0.99}) {
      const auto counts = sample_counts(power, total, samples, offset);
      EXPECT_NEAR(all(counts), samples, 1);
      for (std::size_t i = 0; i < 7; ++i)
        EXPECT_NEAR(counts[i], samples * static_cast<double>(i + 1) / 28, 1) << i;
    }
}

TEST(SampleCounts, OffsetsAverageToTheShare) {
  DoubleColumns power = double_columns(3);
  power[0] = 5, power[block_width] = 3, power[2 * block_width] = 2;
  const double samples = 13;
  std::vector<double> mean(3, 0);
  constexpr int offsets = 1000;
  for (int o = 0; o < offsets; ++o) {
    const auto counts = sample_counts(power, total_power(power), samples, (o + 0.5) / offsets);
    for (std::size_t i = 0; i < 3; ++i) mean[i] += static_cast<double>(counts[i]) / offsets;
  }
  // Every count takes one of two values; its share of offsets is known to one in a thousand.
  EXPECT_NEAR(mean[0], 6.5, 2e-3);
  EXPECT_NEAR(mean[1], 3.9, 2e-3);
  EXPECT_NEAR(mean[2], 2.6, 2e-3);
}

TEST(SampleCounts, EverySunsPowerIsSampled) {
  const auto power = two_suns(100);
  const auto total = total_power(power);
  const auto counts = sample_counts(power, total, 5000, 0.5);
  EXPECT_EQ(counts[0], 0u);  // no sun has power there
  for (std::size_t i = 1; i < 100; ++i) EXPECT_GE(counts[i], 1u) << i;
  // Suns weigh alike, however faint: half of the samples are the second sun's.
  EXPECT_NEAR(counts[99], 5000 * (0.5 + 0.5 * 99 / 4950), 1);
}

TEST(SampleCounts, OneAtLeastWhereFewAreWanted) {
  const auto power = two_suns(50);
  const auto counts = sample_counts(power, total_power(power), 3, 0.1);
  EXPECT_EQ(counts[0], 0u);
  for (std::size_t i = 1; i < 50; ++i) EXPECT_GE(counts[i], 1u);
  EXPECT_LE(all(counts), 49 + 3);
}

TEST(SampleCounts, RefusesMoreThanCanBeKept) {
  const auto power = two_suns(5);
  EXPECT_THROW(sample_counts(power, total_power(power), 2 * most_samples, 0), InputError);
  EXPECT_THROW(sample_counts(power, total_power(power), std::nan(""), 0), InputError);
  try {
    sample_counts(power, total_power(power), 1e25, 0);
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("1.0e+25 samples in one shot (at most 2.0e+09)"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace sunload
