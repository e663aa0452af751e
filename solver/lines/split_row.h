// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Links of several parts of a row, sorted once for each part and for all together.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/lines/link_table.h"

namespace sunload {

/// Keeps its room from row to row.
class SplitRow {
 public:
  /// Sorts links by target and merges links to the same target, whose weights add up in their
  /// order. The links of part p end before `end[p]`, where those of the next part begin.
  void sort(std::span<const LinkTable::Link> links, std::span<const std::uint32_t> end);
  std::span<const LinkTable::Link> of_all() const { return of_all_; }
  std::span<const LinkTable::Link> of_part(std::size_t part) const { return of_part_[part]; }

 private:
  struct Place {
    std::uint32_t target, link;
  };
  std::vector<Place> order_, scratch_;
  std::vector<std::uint32_t> part_;  ///< of each link
  std::vector<LinkTable::Link> merged_, merged_by_part_;
  std::span<const LinkTable::Link> of_all_;
  std::vector<std::span<const LinkTable::Link>> of_part_;
  std::vector<LinkTable::Link*> last_;  ///< of each part, so far
};

}  // namespace sunload
