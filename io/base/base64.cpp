// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/base64.h"

#include <openssl/evp.h>

#include <algorithm>

namespace sunload {

std::string base64(std::span<const unsigned char> bytes) {
  // Lengths are ints there: so many bytes at a time, a multiple of 3 that leaves no padding within.
  constexpr std::size_t most_bytes = 3 << 28;
  std::string text;
  while (!bytes.empty()) {
    const auto part = bytes.first(std::min(bytes.size(), most_bytes));
    const std::size_t begin = text.size(), length = (part.size() + 2) / 3 * 4;
    text.resize(begin + length + 1);  // and a zero byte
    EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data() + begin), part.data(),
                    static_cast<int>(part.size()));
    text.resize(begin + length);
    bytes = bytes.subspan(part.size());
  }
  return text;
}

}  // namespace sunload
