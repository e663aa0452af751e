// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/mesh/descent.h"

#include "geo/base/vector_code.h"

namespace sunload {

namespace {

/// Without branches, which would be guessed wrong half of the time. In the shape that compilers
/// turn into vector code.
template <std::size_t lanes>
[[gnu::always_inline]] inline void descend_side_by_side(const Split* __restrict splits,
                                                        PointColumns<lanes>& __restrict points) {
  alignas(64) std::uint32_t child[lanes];
  for (std::uint32_t leaves = 0; leaves < lanes;) {
    for (std::size_t l = 0; l < lanes; ++l) {
      // With p and q at the ends of the longest edge, m its middle, and the apex r: child 0 is
      // (p, m, r), child 1 is (m, q, r).
      const std::int32_t split = points.split[l], apex = split & 3;
      const std::int32_t a = points.w0[l], b = points.w1[l], c = points.w2[l];
      const std::int32_t p = apex == 0 ? b : apex == 1 ? c : a;
      const std::int32_t q = apex == 0 ? c : apex == 1 ? a : b;
      const std::int32_t r = apex == 0 ? a : apex == 1 ? b : c;
      const std::int32_t larger = p > q ? p : q, smaller = p > q ? q : p;
      const std::int32_t rest = larger - smaller, twice = smaller + smaller;
      points.w0[l] = q > p ? twice : rest;
      points.w1[l] = q > p ? rest : twice;
      points.w2[l] = r;
      const std::int32_t second = q > p ? 1 : 0, inner = (split >> 2) + second;
      child[l] = static_cast<std::uint32_t>(split < 0 ? 0 : inner);
    }
    leaves = 0;
    for (std::size_t l = 0; l < lanes; ++l) {
      const std::int32_t half = splits[child[l]];
      points.split[l] = points.split[l] < 0 ? points.split[l] : half;
    }
    for (std::size_t l = 0; l < lanes; ++l) leaves += points.split[l] < 0 ? 1u : 0u;
  }
}

}  // namespace

SUNLOAD_VECTOR_CODE void descend(const Split* splits, PointsTogether& points) {
  descend_side_by_side(splits, points);
}

void descend(const Split* splits, PointColumns<1>& point) {
  if (point.split[0] >= 0) descend_side_by_side(splits, point);
}

}  // namespace sunload
