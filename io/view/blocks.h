// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Numbers of a page: blocks of deflated bytes in base64, which its JSON names by their place.
#pragma once

#include <cstring>
#include <string>
#include <vector>

#include "io/base/deflate.h"

namespace sunload {

/// Elements of page text: `<script id="block-N">`.
struct ViewBlocks {
  std::vector<std::string> base64;

  /// Number of the new block.
  std::size_t add(const Bytes& bytes);
  template <class Number>
  std::size_t add(const std::vector<Number>& numbers) {
    Bytes bytes(numbers.size() * sizeof(Number));
    if (!bytes.empty()) std::memcpy(bytes.data(), numbers.data(), bytes.size());
    return add(bytes);
  }
};

}  // namespace sunload
