// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Rows of parts, and of all of them, are what each would be sorted and merged alone.
#include "solver/lines/split_row.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "solver/base/rng.h"

namespace sunload::test {
namespace {

using Link = LinkTable::Link;

std::vector<Link> merged(std::vector<Link> links) {
  std::stable_sort(links.begin(), links.end(),
                   [](const Link& a, const Link& b) { return a.target < b.target; });
  std::vector<Link> row;
  for (const Link& link : links) {
    if (row.empty() || row.back().target != link.target)
      row.push_back(link);
    else
      row.back().weight += link.weight;
  }
  return row;
}

void expect_same(std::span<const Link> row, const std::vector<Link>& expected) {
  ASSERT_EQ(row.size(), expected.size());
  for (std::size_t l = 0; l < row.size(); ++l) {
    EXPECT_EQ(row[l].target, expected[l].target);
    EXPECT_EQ(row[l].weight, expected[l].weight);  // added up in the same order: the same bits
  }
}

/// Of few links and many, of few targets and as many as there may be, with parts that have none.
TEST(SplitRow, IsWhatEveryPartAndAllWouldBeAlone) {
  SplitRow split;
  std::uint32_t cases = 0;
  for (const std::size_t targets : {std::size_t{1}, std::size_t{3}, std::size_t{700},
                                    std::size_t{1} << 18, LinkTable::most_targets})
    for (const std::uint32_t parts : {1u, 2u, 8u})
      for (const std::uint32_t most : {0u, 1u, 5u, 40u, 300u}) {
        std::vector<Link> links;
        std::vector<std::uint32_t> end;
        std::vector<std::vector<Link>> of_part(parts);
        for (std::uint32_t p = 0; p < parts; ++p) {
          const auto some = random_words({.seed = 1, .realization = p, .sun = cases});
          for (std::uint32_t l = 0; l < (p == 1 ? 0 : some[0] % (most + 1)); ++l) {
            const auto random =
                random_words({.seed = 2, .realization = p, .element = l, .sun = cases});
            of_part[p].push_back({static_cast<std::uint32_t>(random[0] % targets),
                                  random[1] % 3 == 0 ? uniform(random[2]) : 1.0f});
          }
          links.insert(links.end(), of_part[p].begin(), of_part[p].end());
          end.push_back(static_cast<std::uint32_t>(links.size()));
        }
        split.sort(links, end);
        expect_same(split.of_all(), merged(links));
        for (std::uint32_t p = 0; p < parts; ++p) expect_same(split.of_part(p), merged(of_part[p]));
        ++cases;
      }
}

}  // namespace
}  // namespace sunload::test
