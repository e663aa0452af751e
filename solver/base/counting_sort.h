// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Stable sorts by whole numbers: linear, no comparisons.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sunload {

inline constexpr std::uint32_t most_digits = 512;

/// Writes `from` to `to`, ordered by digit_of(item) below `digits` ≤ `most_digits`; items of one
/// digit keep their order.
template <class Item, class DigitOf>
void sort_by_digit(const std::vector<Item>& from, std::vector<Item>& to, std::uint32_t digits,
                   DigitOf&& digit_of) {
  std::uint32_t begin[most_digits + 1];
  std::fill_n(begin, digits + 1, 0u);
  for (const Item& item : from) ++begin[digit_of(item) + 1];
  for (std::uint32_t d = 0; d < digits; ++d) begin[d + 1] += begin[d];
  to.resize(from.size());
  for (const Item& item : from) to[begin[digit_of(item)]++] = item;
}

/// Sorts `items` by number_of(item), a std::uint32_t; items of one number keep their order.
/// `scratch` is room that calls may share. Few items are sorted by insertion, many by one digit
/// after another.
template <class Item, class NumberOf>
void sort_by_number(std::vector<Item>& items, std::vector<Item>& scratch, NumberOf&& number_of) {
  constexpr std::size_t few = 40;
  if (items.size() <= few) {
    for (std::size_t i = 1; i < items.size(); ++i) {
      const Item item = items[i];
      std::size_t at = i;
      for (; at > 0 && number_of(items[at - 1]) > number_of(item); --at) items[at] = items[at - 1];
      items[at] = item;
    }
    return;
  }
  std::uint32_t all_bits = 0;
  for (const Item& item : items) all_bits |= number_of(item);
  constexpr std::uint32_t most_bits = std::bit_width(most_digits - 1);
  const std::uint32_t bits = std::bit_width(all_bits);
  const std::uint32_t passes = (bits + most_bits - 1) / most_bits;
  const std::uint32_t bits_each = passes > 0 ? (bits + passes - 1) / passes : 0;
  for (std::uint32_t shift = 0; shift < bits; shift += bits_each) {
    const std::uint32_t digits = 1u << bits_each;
    sort_by_digit(items, scratch, digits,
                  [&](const Item& item) { return number_of(item) >> shift & (digits - 1); });
    items.swap(scratch);
  }
}

}  // namespace sunload
