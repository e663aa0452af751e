// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Arrays of many equal numbers, written by all threads: one alone would keep the others waiting
/// between blocks of suns.
#pragma once

#include <algorithm>
#include <cstddef>

#include "solver/base/large_memory.h"
#include "solver/base/threads.h"

namespace sunload {

template <class Real>
LargeVector<Real> large_filled(std::size_t count, Real value) {
  constexpr std::size_t bytes_per_chunk = std::size_t{1} << 18;
  LargeVector<Real> filled(count);  // of anything
  parallel_chunks(count, bytes_per_chunk / sizeof(Real), [&](std::size_t begin, std::size_t end) {
    std::fill(filled.data() + begin, filled.data() + end, value);
  });
  return filled;
}

/// `count` zeros.
template <class Real>
LargeVector<Real> large_zeros(std::size_t count) {
  return large_filled(count, Real{0});
}

}  // namespace sunload
