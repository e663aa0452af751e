// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Links come back as they were put in, and most of them take a word.
#include "solver/lines/link_table.h"

#include <gtest/gtest.h>

#include <map>
#include <numeric>

#include "solver/base/rng.h"

namespace sunload::test {
namespace {

using Link = LinkTable::Link;

std::vector<std::vector<Link>> rows_of(const LinkTable::Block& block) {
  LinkTable::Reader read(block);
  std::vector<std::vector<Link>> rows(block.rows());
  for (auto& row : rows) {
    row.resize(read.next_row());
    for (Link& link : row) link = read.next();
  }
  return rows;
}

/// Sorted and merged: the same for short rows and long ones.
TEST(LinkTable, MergesLinksToTheSameTarget) {
  for (const std::uint32_t count : {0u, 1u, 30u, 48u, 49u, 3000u}) {
    std::vector<Link> links;
    std::map<std::uint32_t, double> expected;
    for (std::uint32_t l = 0; l < count; ++l) {
      const std::uint32_t target = l * 2654435761u % (count + 1) * 70'001u / 2;
      const float weight = 1 + static_cast<float>(l % 4);
      links.push_back({target, weight});
      expected[target] += static_cast<double>(weight) / 8;
    }
    LinkTable::Block block(std::size_t{1} << 28);
    block.append_row(links, 0.125f);
    const auto rows = rows_of(block);
    ASSERT_EQ(rows.size(), 1u);
    ASSERT_EQ(rows[0].size(), expected.size());
    std::size_t at = 0;
    for (const auto& [target, weight] : expected) {
      EXPECT_EQ(rows[0][at].target, target);
      EXPECT_EQ(static_cast<double>(rows[0][at++].weight), weight);  // eighths: exact
    }
  }
}

/// Whole numbers of lines, shares of them, and more lines than there are bits beside a target:
/// for targets of few bits and of many, in rows of one unit and of several.
TEST(LinkTable, GivesBackEveryWeight) {
  for (const std::size_t targets :
       {std::size_t{1}, std::size_t{6}, std::size_t{1000}, LinkTable::most_targets}) {
    for (const bool same_units : {true, false}) {
      LinkTable::Block block(targets);
      std::vector<std::vector<Link>> expected;
      for (std::uint32_t row = 0; row < 40; ++row) {
        const float unit = 1 / static_cast<float>(same_units ? 96 : 96 + row / 8);
        std::vector<Link> links;
        for (std::uint32_t l = 0; l < row % 7; ++l) {
          const auto random = random_words({.seed = row, .sun = l});
          const std::size_t target = (l * targets + random[0] % targets) / 7;  // each its own …
          if (!links.empty() && links.back().target == target) continue;       // … or left out
          const float lines = static_cast<float>(random[1] % 300);
          links.push_back(
              {static_cast<std::uint32_t>(target), random[2] % 2 == 0 ? lines : lines * 0.3f});
        }
        expected.push_back(links);
        for (Link& link : expected.back()) link.weight *= unit;
        block.append_row(links, unit);
      }
      block.trim();
      const auto rows = rows_of(block);
      ASSERT_EQ(rows.size(), expected.size());
      for (std::size_t row = 0; row < rows.size(); ++row) {
        ASSERT_EQ(rows[row].size(), expected[row].size());
        for (std::size_t l = 0; l < rows[row].size(); ++l) {
          EXPECT_EQ(rows[row][l].target, expected[row][l].target);
          EXPECT_EQ(rows[row][l].weight, expected[row][l].weight);
        }
      }
    }
  }
}

TEST(LinkTable, AsksNoFurtherAheadThanThereAreLinks) {
  LinkTable::Block block(100);
  std::vector<Link> links{{3, 1}, {5, 0.5f}, {70, 2}};
  block.append_row(links, 1);
  LinkTable::Reader read(block);
  read.next_row();
  EXPECT_EQ(read.target_ahead(0), 3u);
  EXPECT_EQ(read.target_ahead(1), 5u);
  EXPECT_EQ(read.target_ahead(2), 70u);
  EXPECT_EQ(read.target_ahead(16), 70u);
  read.next();
  EXPECT_EQ(read.target_ahead(0), 5u);
  read.next();
  EXPECT_EQ(read.target_ahead(16), 70u);
}

/// Of lines that end on what is diffuse; what the words save is why they are there.
TEST(LinkTable, TakesAWordForALinkOfWholeLines) {
  LinkTable::Block block(1 << 24);
  std::vector<Link> links;
  for (std::uint32_t row = 0; row < LinkTable::rows_per_block; ++row) {
    links.clear();
    for (std::uint32_t l = 0; l < 200; ++l) links.push_back({l * 7 + row, 1});
    block.append_row(links, 1.0f / 256);
  }
  std::size_t bytes = 0;
  LinkTable::Block::visit(block, [&](const auto& array) { bytes += 4 * array.size(); });
  EXPECT_EQ(bytes, 4 * (block.link_count() + LinkTable::rows_per_block + 1 + 1 + 1));
}

}  // namespace
}  // namespace sunload::test
