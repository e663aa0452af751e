// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Arrays of any size come and go, and lie where vector code expects them.
#include "solver/base/large_memory.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace sunload::test {
namespace {

template <class Real>
using Numbers = std::vector<Real, LargeMemory<Real>>;

TEST(LargeMemory, BeginsAtACacheLineWhateverItsSize) {
  // Below and above the size from which pages are large ones, whole pages and not.
  for (const std::size_t count : {1u, 1000u, 1'048'575u, 1'048'576u, 1'048'577u, 5'000'000u}) {
    Numbers<float> numbers(count, 1.0f);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(numbers.data()) % 64, 0u) << count;
    EXPECT_EQ(std::accumulate(numbers.begin(), numbers.end(), 0.0), static_cast<double>(count));
  }
}

TEST(LargeMemory, IsThatOfVectorsThatGrowAndMove) {
  Numbers<double> numbers;
  for (int k = 0; k < 1'500'000; ++k) numbers.push_back(k);  // from small pages into large ones
  Numbers<double> copy = numbers, moved = std::move(numbers);
  EXPECT_EQ(copy, moved);
  EXPECT_EQ(moved.back(), 1'499'999.0);
  copy.resize(10);
  copy.shrink_to_fit();
  EXPECT_EQ(copy.back(), 9.0);
}

}  // namespace
}  // namespace sunload::test
