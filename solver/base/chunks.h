// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Chunks of parallel loops (solver/base/threads.h).
#pragma once

#include <cstddef>

namespace sunload {

/// Patches or sensors that one thread takes at a time. Sums over chunks are added in their order:
/// another number gives other bits.
inline constexpr std::size_t receivers_per_chunk = 256;

/// Chunks that make `count`.
constexpr std::size_t chunk_count(std::size_t count, std::size_t chunk) {
  return (count + chunk - 1) / chunk;
}

}  // namespace sunload
