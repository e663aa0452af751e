// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/light/packed_columns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace sunload {
namespace {

/// Values of rows between which lie many powers of ten, and some that are 0.
Columns random_columns(std::size_t rows) {
  std::mt19937 random(20261126);
  std::uniform_real_distribution<float> value(0, 1), power(-6, 6);
  Columns columns(rows * block_width);
  for (std::size_t i = 0; i < rows; ++i) {
    const float scale = std::pow(10.0f, power(random));
    for (std::size_t k = 0; k < block_width; ++k)
      columns[i * block_width + k] = k % 3 == 2 ? 0 : scale * value(random);
  }
  return columns;
}

std::array<float, block_width> row_of(const PackedColumns& packed, std::size_t i) {
  std::array<float, block_width> row;
  for (std::size_t k = 0; k < block_width; ++k) row[k] = packed.at(i, k);
  return row;
}

TEST(PackedColumns, KeepValuesToHalfAStepOfTheirRow) {
  const Columns columns = random_columns(3000);
  const PackedColumns packed(columns);
  ASSERT_EQ(packed.rows(), 3000u);
  std::array<float, block_width> of_column{};
  for (std::size_t at = 0; at < columns.size(); ++at)
    of_column[at % block_width] = std::max(of_column[at % block_width], columns[at]);
  double sum = 0, sum_of_packed = 0;
  for (std::size_t i = 0; i < packed.rows(); ++i) {
    const float* const from = columns.data() + i * block_width;
    float largest_share = 0;
    for (std::size_t k = 0; k < block_width; ++k)
      if (of_column[k] > 0) largest_share = std::max(largest_share, from[k] / of_column[k]);
    const auto row = row_of(packed, i);
    // And five roundings of products and quotients, of 2^-24 of a value each: 4 % of half a step.
    const float step = largest_share / 65535 * 1.05f;
    for (std::size_t k = 0; k < block_width; ++k) {
      EXPECT_NEAR(row[k], from[k], step / 2 * of_column[k]) << i;
      EXPECT_TRUE(from[k] > 0 || row[k] == 0.0f) << i;
      if (of_column[k] == 0.0f) continue;
      sum += static_cast<double>(from[k] / of_column[k] / largest_share);
      sum_of_packed += static_cast<double>(row[k] / of_column[k] / largest_share);
    }
  }
  // Rounded to the nearest, not down: 32 000 values would miss half a step each, 0.24 in all; to
  // the nearest they miss the root of their number times 0.29 steps: 0.0008.
  EXPECT_NEAR(sum_of_packed, sum, 0.004);
}

/// As of a winter's sky beside a summer's: a column of small values keeps its digits.
TEST(PackedColumns, KnowSmallColumnsAsWellAsLargeOnes) {
  Columns values = columns(100);
  for (std::size_t i = 0; i < 100; ++i) {
    values[i * block_width] = 100.0f + static_cast<float>(i);
    values[i * block_width + 1] = 1e-3f * (50.0f + static_cast<float>(i));
  }
  const PackedColumns packed(values);
  for (std::size_t i = 0; i < 100; ++i)
    EXPECT_NEAR(packed.at(i, 1), values[i * block_width + 1], 0.15f / 65535);
}

TEST(PackedColumns, KnowTheOnlyColumnToARounding) {
  Columns values = columns(2000);
  std::mt19937 random(20261127);
  std::uniform_real_distribution<float> power(-6, 6);
  for (std::size_t i = 0; i < 2000; ++i)
    values[i * block_width + 3] = std::pow(10.0f, power(random));
  const PackedColumns packed(values);
  for (std::size_t i = 0; i < 2000; ++i) {
    const float value = values[i * block_width + 3];
    EXPECT_NEAR(packed.at(i, 3), value, 4e-7f * value);  // six roundings
  }
}

TEST(PackedColumns, OfNothingAreNothing) {
  EXPECT_TRUE(PackedColumns().empty());
  EXPECT_TRUE(PackedColumns(Columns()).empty());
  const PackedColumns dark(columns(2));
  EXPECT_FALSE(dark.empty());
  for (const float value : row_of(dark, 1)) EXPECT_EQ(value, 0.0f);
}

TEST(PackedColumns, WhatFallsBelowZeroByARoundingIsZero) {
  Columns values = columns(1);
  values[0] = 10;
  values[1] = -1e-6f;
  const PackedColumns packed(values);
  EXPECT_NEAR(packed.at(0, 0), 10.0f, 4e-6f);
  EXPECT_EQ(packed.at(0, 1), 0.0f);
}

}  // namespace
}  // namespace sunload
