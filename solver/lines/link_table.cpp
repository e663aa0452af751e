// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/lines/link_table.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "geo/base/check.h"
#include "solver/base/counting_sort.h"

namespace sunload {

namespace {

/// By target. Few links are sorted by comparison, many by a byte of the target after another.
void sort_links(std::vector<LinkTable::Link>& links) {
  using Link = LinkTable::Link;
  constexpr std::size_t few = 48;
  if (links.size() <= few) {
    // By insertion: links with the same target keep their order, as below.
    for (std::size_t i = 1; i < links.size(); ++i) {
      const Link link = links[i];
      std::size_t at = i;
      for (; at > 0 && links[at - 1].target > link.target; --at) links[at] = links[at - 1];
      links[at] = link;
    }
    return;
  }
  std::uint32_t all_bits = 0;
  for (const Link& link : links) all_bits |= link.target;
  thread_local std::vector<Link> sorted;
  for (std::uint32_t shift = 0; shift < 32 && all_bits >> shift != 0; shift += 8) {
    sort_by_byte(links, sorted, [shift](const Link& link) {
      return static_cast<std::uint8_t>(link.target >> shift);
    });
    links.swap(sorted);
  }
}

}  // namespace

LinkTable::LinkTable(std::size_t rows, std::size_t targets)
    : blocks((rows + rows_per_block - 1) / rows_per_block, Block(targets)), targets_(targets) {}

LinkTable::Block::Block(std::size_t targets)
    : target_bits_(static_cast<std::uint32_t>(std::bit_width(targets - (targets > 0)))) {
  SUNLOAD_EXPECT(targets <= most_targets, "a word has room for a target and a line");
}

void LinkTable::Block::append_row(std::vector<Link>& links, float unit) {
  append_unit(unit);
  sort_links(links);
  for (std::size_t l = 0; l < links.size();) {
    const auto target = links[l].target;
    float weight = 0;
    for (; l < links.size() && links[l].target == target; ++l) weight += links[l].weight;
    append(target, weight);
  }
  begin_.push_back(static_cast<std::uint32_t>(word_.size()));
}

/// `weight`: in units of the row at hand.
void LinkTable::Block::append(std::uint32_t target, float weight) {
  // Whole numbers up to this are floats.
  constexpr float most_exact = 1 << 24;
  const std::uint32_t most_lines = ~std::uint32_t{0} >> target_bits_;
  const bool is_of_lines = weight >= 1 &&
                           weight <= std::min(most_exact, static_cast<float>(most_lines)) &&
                           weight == std::floor(weight);
  const std::uint32_t lines = is_of_lines ? static_cast<std::uint32_t>(weight) : 0;
  word_.push_back(target | lines << target_bits_);
  if (is_of_lines) return;
  other_.back() = weight * unit_.back();
  other_.push_back(0);
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
