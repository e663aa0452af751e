// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/light/packed_columns.h"

#include <gtest/gtest.h>

#include <algorithm>
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

float largest_of(const float* row) { return *std::max_element(row, row + block_width); }

TEST(PackedColumns, KeepValuesToHalfAStepOfTheirRow) {
  const Columns columns = random_columns(3000);
  const PackedColumns packed(columns);
  ASSERT_EQ(packed.rows(), 3000u);
  double sum = 0, sum_of_packed = 0;
  for (std::size_t i = 0; i < packed.rows(); ++i) {
    const float* const from = columns.data() + i * block_width;
    const auto row = packed.row(i);
    // And a rounding of the product and of the quotient.
    const float step = largest_of(from) / 65535 * 1.01f;
    for (std::size_t k = 0; k < block_width; ++k) {
      EXPECT_NEAR(row[k], from[k], step / 2) << i;
      EXPECT_TRUE(from[k] > 0 || row[k] == 0.0f) << i;
      sum += static_cast<double>(from[k] / largest_of(from));
      sum_of_packed += static_cast<double>(row[k] / largest_of(from));
    }
  }
  // Rounded to the nearest, not down: 32 000 values would miss half a step each, 0.24 in all; to
  // the nearest they miss the root of their number times 0.29 steps: 0.0008.
  EXPECT_NEAR(sum_of_packed, sum, 0.004);
}

TEST(PackedColumns, OfNothingAreNothing) {
  EXPECT_TRUE(PackedColumns().empty());
  EXPECT_TRUE(PackedColumns(Columns()).empty());
  const PackedColumns dark(columns(2));
  EXPECT_FALSE(dark.empty());
  for (const float value : dark.row(1)) EXPECT_EQ(value, 0.0f);
}

TEST(PackedColumns, WhatFallsBelowZeroByARoundingIsZero) {
  Columns values = columns(1);
  values[0] = 10;
  values[1] = -1e-6f;
  const PackedColumns packed(values);
  EXPECT_EQ(packed.row(0)[0], 10.0f);
  EXPECT_EQ(packed.row(0)[1], 0.0f);
}

}  // namespace
}  // namespace sunload
