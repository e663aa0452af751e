// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Stable sort by a byte: linear, no comparisons.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sunload {

/// Writes `from` to `to`, ordered by byte_of(item) in 0 … 255; items of one byte keep their order.
template <class Item, class ByteOf>
void sort_by_byte(const std::vector<Item>& from, std::vector<Item>& to, ByteOf&& byte_of) {
  constexpr std::size_t bytes = 256;
  std::size_t begin[bytes + 1] = {};
  for (const Item& item : from) ++begin[byte_of(item) + 1];
  for (std::size_t b = 0; b < bytes; ++b) begin[b + 1] += begin[b];
  to.resize(from.size());
  for (const Item& item : from) to[begin[byte_of(item)]++] = item;
}

}  // namespace sunload
