// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Numbers as the bytes that binary files hold, whatever the order of the machine's own bytes.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <string>

namespace sunload {

/// Appends a number's bytes in that order.
template <std::endian order, class Number>
void append_bytes(std::string& bytes, Number number) {
  auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(number);
  if constexpr (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  bytes.append(raw.data(), raw.size());
}

}  // namespace sunload
