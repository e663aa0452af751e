// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/mesh/bisection.h"

#include <tuple>

namespace sunload {

namespace {

std::tuple<double, double, double> ordered(Vec3 p) { return {p.x, p.y, p.z}; }

/// Length and place of an edge: no two edges of a triangle have equal ones.
struct EdgeRank {
  double length_squared;
  std::tuple<double, double, double> low, high;

  EdgeRank(Vec3 a, Vec3 b) : length_squared(dot(b - a, b - a)), low(ordered(a)), high(ordered(b)) {
    if (high < low) std::swap(low, high);
  }
  bool is_longer_than(const EdgeRank& other) const {
    if (length_squared != other.length_squared) return length_squared > other.length_squared;
    return std::tie(low, high) < std::tie(other.low, other.high);
  }
};

}  // namespace

std::uint8_t apex_of_longest_edge(const std::vector<Vec3>& vertices, const Corners& c) {
  const auto rank = [&](std::uint8_t apex) {
    const auto [p, q] = edge_opposite(c, apex);
    return EdgeRank(vertices[static_cast<std::size_t>(p)], vertices[static_cast<std::size_t>(q)]);
  };
  std::uint8_t apex = 0;
  EdgeRank longest = rank(0);
  for (std::uint8_t k = 1; k < 3; ++k)
    if (const EdgeRank edge = rank(k); edge.is_longer_than(longest)) {
      longest = edge;
      apex = k;
    }
  return apex;
}

std::array<Corners, 2> halves(const Corners& c, std::uint8_t apex, std::int32_t midpoint) {
  const auto p = c[(apex + 1u) % 3], q = c[(apex + 2u) % 3], r = c[apex];
  return {Corners{p, midpoint, r}, Corners{midpoint, q, r}};
}

}  // namespace sunload
