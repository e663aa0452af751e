// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/lines/split_row.h"

#include "solver/base/counting_sort.h"

namespace sunload {

namespace {

using Link = LinkTable::Link;

/// Before the first link of a row: no link leads there.
constexpr Link none{~std::uint32_t{0}, 0};

/// Adds a link to the last one of its row, or after it; without a branch, since which it is can
/// hardly be guessed.
void add(const Link& link, Link*& last) {
  const bool is_next = link.target != last->target;
  last += is_next;
  *last = {link.target, (is_next ? 0.0f : last->weight) + link.weight};
}

}  // namespace

void SplitRow::sort(std::span<const Link> links, std::span<const std::uint32_t> end) {
  order_.resize(links.size());
  part_.resize(links.size());
  merged_.resize(links.size() + 1);
  merged_by_part_.resize(links.size() + end.size());
  of_part_.resize(end.size());
  last_.resize(end.size());
  std::uint32_t at = 0;
  for (std::uint32_t p = 0; p < end.size(); ++p) {
    last_[p] = merged_by_part_.data() + at + p;
    *last_[p] = none;
    for (; at < end[p]; ++at) {
      part_[at] = p;
      order_[at] = {links[at].target, at};
    }
  }
  sort_by_number(order_, scratch_, [](const Place& place) { return place.target; });
  Link* last = merged_.data();
  *last = none;
  for (const Place& place : order_) {
    add(links[place.link], last);
    add(links[place.link], last_[part_[place.link]]);
  }
  of_all_ = {merged_.data() + 1, last + 1};
  for (std::size_t p = 0, begin = 0; p < end.size(); begin = end[p++])
    of_part_[p] = {merged_by_part_.data() + begin + p + 1, last_[p] + 1};
}

}  // namespace sunload
