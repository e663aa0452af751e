// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/view/blocks.h"

#include "io/base/base64.h"

namespace sunload {
namespace {

// Slower levels make the page smaller by hundredths only.
constexpr int deflate_level = 6;

}  // namespace

std::size_t ViewBlocks::add(const Bytes& bytes) {
  base64.push_back(sunload::base64(zlib_deflated(bytes, deflate_level)));
  return base64.size() - 1;
}

}  // namespace sunload
