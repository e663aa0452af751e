// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/batch/chunk.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "solver/base/threads.h"

namespace sunload::test {
namespace {

constexpr ChunkShape shape{64, 4096};

enum class Kind { zeros, smooth, noise, half_dark };

std::vector<float> values_of(Kind kind, std::size_t rows, std::size_t columns) {
  std::mt19937 random(1);
  std::vector<float> values;
  for (std::size_t i = 0; i < rows * columns; ++i) {
    const float noise = static_cast<float>(random()) * 0x1p-32F + 100.0F;
    const bool is_dark = kind == Kind::zeros || (kind == Kind::half_dark && i < rows * columns / 2);
    values.push_back(is_dark ? 0.0F : kind == Kind::smooth ? std::floor(noise) : noise);
  }
  return values;
}

TEST(Chunk, RoundTripAndPadding) {
  constexpr std::size_t rows = 40, columns = 5000;
  for (const Kind kind : {Kind::zeros, Kind::smooth, Kind::noise, Kind::half_dark}) {
    const auto values = values_of(kind, rows, columns);
    for (const int level : {0, 1, 4, 9}) {
      const auto chunks = encoded_chunks(values.data(), rows, columns, shape, level);
      ASSERT_EQ(chunks.size(), 2u);
      for (std::size_t c = 0; c < 2; ++c) {
        EXPECT_LE(chunks[c].size(), shape.bytes());
        const auto back = decoded_chunk(chunks[c], shape);
        for (std::size_t row = 0; row < shape.rows; ++row) {
          for (std::size_t i = 0; i < shape.columns; ++i) {
            const std::size_t column = c * shape.columns + i;
            const float value = back[row * shape.columns + i];
            if (row < rows && column < columns) {
              ASSERT_EQ(value, values[row * columns + column]);
            } else {
              ASSERT_TRUE(std::isnan(value));
            }
          }
        }
      }
    }
  }
}

/// Rows of days and nights, the light of an instant much the same on all patches.
std::vector<float> days_and_nights(std::size_t rows, std::size_t columns) {
  std::mt19937 random(5);
  std::vector<float> values;
  for (std::size_t i = 0; i < rows * columns; ++i) {
    const std::size_t hour = i / columns % 24;
    const bool is_dark = hour < 7 || hour > 17;
    const float noise = static_cast<float>(random()) * 0x1p-32F;
    values.push_back(is_dark ? 0.0F : (1.0F + noise) * 100.0F);
  }
  return values;
}

TEST(Chunk, NightsTakeNoRoom) {
  constexpr std::size_t rows = 64, dark_rows = 29, lit_rows = rows - dark_rows;
  for (const std::size_t columns : {std::size_t{4096}, std::size_t{2469}, std::size_t{5000}}) {
    const auto values = days_and_nights(rows, columns);
    const ChunkShape of{rows, std::min(shape.columns, columns)};
    for (const int level : {1, 4, 6, 9}) {
      const auto chunks = encoded_chunks(values.data(), rows, columns, of, level);
      // The last bits of the mantissa are noise, the exponent's byte has two values.
      EXPECT_LT(chunks.front().size(), lit_rows * of.columns * 13 / 4);
      for (std::size_t c = 0; c < chunks.size(); ++c) {
        const auto back = decoded_chunk(chunks[c], of);
        for (std::size_t i = 0; i < back.size(); ++i) {
          const std::size_t column = c * of.columns + i % of.columns;
          if (column < columns) {
            ASSERT_EQ(back[i], values[i / of.columns * columns + column]);
          } else {
            ASSERT_TRUE(std::isnan(back[i]));
          }
        }
      }
    }
  }
}

TEST(Chunk, RunsOfAnyLengthAndByte) {
  // Noise, then a run of any length: it begins and ends anywhere within the pieces looked at.
  std::mt19937 random(6);
  for (const std::uint32_t byte : {0x00U, 0x8fU, 0x90U, 0xffU})
    for (std::size_t run = 3500; run < 3800; ++run) {
      const ChunkShape row{1, 16'384};
      std::vector<float> values;
      for (std::size_t i = 0; i < row.columns; ++i) {
        const bool is_run = i >= row.columns - run;
        const std::uint32_t noise = static_cast<std::uint32_t>(random()) & 0xffffffU;
        values.push_back(std::bit_cast<float>(0x42000000U | (is_run ? byte * 0x10101U : noise)));
      }
      const auto chunk = encoded_chunks(values.data(), 1, row.columns, row, 4).at(0);
      EXPECT_LT(chunk.size(), 3 * (row.columns - run) + 2400);
      ASSERT_EQ(decoded_chunk(chunk, row), values);
    }
}

/// Nearest value of so many bits by doubles, halves to even.
float nearest(float value, int bits) {
  if (value == 0 || !std::isfinite(value)) return value;
  const double unit = std::exp2(std::max(std::ilogb(value), -126) - bits);
  return static_cast<float>(std::nearbyint(static_cast<double>(value) / unit) * unit);
}

TEST(Chunk, RoundsToTheNearestHalvesToEven) {
  EXPECT_EQ(rounded(1 + 0x1p-10F, 9), 1);
  EXPECT_EQ(rounded(1 + 0x3p-10F, 9), 1 + 0x1p-8F);
  EXPECT_EQ(rounded(2 - 0x1p-11F, 9), 2);  // the carry reaches the exponent
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(rounded(infinity, 1), infinity);
  EXPECT_TRUE(std::isnan(rounded(std::numeric_limits<float>::quiet_NaN(), 1)));
  std::mt19937 random(3);
  for (int k = 0; k < 100'000; ++k) {
    const auto value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    if (std::isnan(value)) continue;
    for (const int bits : {1, 9, 22, 23}) ASSERT_EQ(rounded(value, bits), nearest(value, bits));
  }
}

TEST(Chunk, RoundedValuesTakeLess) {
  constexpr std::size_t rows = 64, columns = 5000;
  const auto values = values_of(Kind::noise, rows, columns);
  for (const int level : {0, 4, 6}) {
    const auto all = encoded_chunks(values.data(), rows, columns, shape, level);
    const auto chunks = encoded_chunks(values.data(), rows, columns, shape, level, 9);
    for (std::size_t c = 0; c < 2; ++c) {
      if (level > 0) {
        EXPECT_LT(chunks[c].size(), all[c].size() / 2);
      }
      const auto back = decoded_chunk(chunks[c], shape);
      for (std::size_t i = 0; i < back.size(); ++i) {
        const std::size_t column = c * shape.columns + i % shape.columns;
        if (column >= columns) continue;
        ASSERT_EQ(back[i], rounded(values[i / shape.columns * columns + column], 9));
      }
    }
  }
}

TEST(Chunk, BitPatternsThatDoNotShrinkAreStored) {
  std::mt19937 random(2);
  std::vector<float> values(shape.rows * shape.columns);
  for (auto& value : values) value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
  const auto chunks = encoded_chunks(values.data(), shape.rows, shape.columns, shape, 4);
  EXPECT_EQ(chunks.at(0).size(), shape.bytes());
}

TEST(Chunk, SameBytesForAnyNumberOfThreads) {
  const auto values = values_of(Kind::noise, 64, 20'000);
  const int before = thread_count();
  set_thread_count(1);
  const auto one = encoded_chunks(values.data(), 64, 20'000, shape, 4);
  set_thread_count(7);
  const auto seven = encoded_chunks(values.data(), 64, 20'000, shape, 4);
  set_thread_count(before);
  EXPECT_EQ(one, seven);
}

TEST(Chunk, DamageIsNoticed) {
  const auto values = values_of(Kind::noise, 64, 4096);
  const Bytes good = encoded_chunks(values.data(), 64, 4096, shape, 4).at(0);
  Bytes bad = good;
  bad[bad.size() / 2] ^= 1U;
  EXPECT_THROW(decoded_chunk(bad, shape), std::runtime_error);
  EXPECT_THROW(decoded_chunk({good.data(), good.size() / 2}, shape), std::runtime_error);
  EXPECT_THROW(decoded_chunk(good, {32, 4096}), std::runtime_error);
}

}  // namespace
}  // namespace sunload::test
