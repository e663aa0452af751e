// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/lines/link_table.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "geo/base/check.h"
#include "solver/base/counting_sort.h"

namespace sunload {

LinkTable::LinkTable(std::size_t rows, std::size_t targets)
    : blocks((rows + rows_per_block - 1) / rows_per_block, Block(targets)), targets_(targets) {}

LinkTable::Block::Block(std::size_t targets)
    : target_bits_(static_cast<std::uint32_t>(std::bit_width(targets - (targets > 0)))) {
  SUNLOAD_EXPECT(targets <= most_targets, "a word has room for a target and a line");
}

void LinkTable::Block::append_row(std::vector<Link>& links, float unit) {
  thread_local std::vector<Link> scratch;
  sort_by_number(links, scratch, [](const Link& link) { return link.target; });
  std::size_t merged = 0;
  for (const Link& link : links) {
    if (merged > 0 && links[merged - 1].target == link.target)
      links[merged - 1].weight += link.weight;
    else
      links[merged++] = link;
  }
  append_merged(std::span(links).first(merged), unit);
}

void LinkTable::Block::append_merged(std::span<const Link> links, float unit) {
  append_unit(unit);
  // Whole numbers up to this are floats.
  constexpr float most_exact = 1 << 24;
  const std::uint32_t most_lines = ~std::uint32_t{0} >> target_bits_;
  const float most = std::min(most_exact, static_cast<float>(most_lines));
  const std::size_t before = word_.size();
  word_.resize(before + links.size());
  std::uint32_t* word = word_.data() + before;
  for (const auto& [target, weight] : links) {
    const bool has_room = weight >= 1 && weight <= most;
    auto lines = static_cast<std::uint32_t>(has_room ? weight : 0);
    if (static_cast<float>(lines) != weight) lines = 0;
    *word++ = target | lines << target_bits_;
    if (lines != 0) continue;
    other_.back() = weight * unit;
    other_.push_back(0);
  }
  begin_.push_back(static_cast<std::uint32_t>(word_.size()));
}

void LinkTable::Block::append_unit(float unit) {
  const std::size_t before = rows();
  if (before == 0) {
    unit_.assign(1, unit);
    return;
  }
  if (unit_.size() == 1 && unit_[0] == unit) return;
  if (unit_.size() == 1) unit_.resize(before, unit_[0]);
  unit_.push_back(unit);
}

void LinkTable::Block::trim() {
  word_.shrink_to_fit();
  unit_.shrink_to_fit();
  other_.shrink_to_fit();
}

}  // namespace sunload
