// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/base/random_blocks.h"

#include <gtest/gtest.h>

namespace sunload {
namespace {

TEST(RandomBlocks, OverlapIsSeenFromBothSides) {
  EXPECT_TRUE(are_disjoint(std::array<RandomBlocks, 2>{{{0, 8}, {8, 8}}}));
  EXPECT_FALSE(are_disjoint(std::array<RandomBlocks, 2>{{{0, 9}, {8, 8}}}));
  EXPECT_FALSE(are_disjoint(std::array<RandomBlocks, 2>{{{8, 8}, {0, 9}}}));
  EXPECT_FALSE(are_disjoint(std::array<RandomBlocks, 2>{{{0, 64}, {8, 8}}}));
}

// They would begin again at 0.
TEST(RandomBlocks, BeyondTheLastAreRefused) {
  EXPECT_TRUE(are_disjoint(std::array<RandomBlocks, 1>{{{0xffffff00u, 255}}}));
  EXPECT_FALSE(are_disjoint(std::array<RandomBlocks, 1>{{{0xffffff00u, 257}}}));
}

// The last surface of the longest chain, and the last iteration, have words of their own.
TEST(RandomBlocks, ReachAsFarAsStudiesMay) {
  using namespace shot_blocks;
  for (std::uint32_t iteration = 0; iteration < of_iterations.count; ++iteration) {
    const RandomBlocks chain = of_chain(iteration);
    EXPECT_GE(chain.first, of_all_chains.first);
    EXPECT_LE(chain.end(), of_all_chains.end());
    EXPECT_EQ(chain.end(), of_chain(iteration + 1).first);
  }
  EXPECT_GE(of_iterations.count, std::uint32_t{most_reflections} + 1);
  EXPECT_GE(blocks_of_chain, std::uint32_t{most_reflections} + 1);
}

}  // namespace
}  // namespace sunload
