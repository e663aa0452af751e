// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Longest-edge bisection of triangles, decided by geometry alone.
/// Rivara (1984), Algorithms for refining triangular grids.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "geo/base/vec.h"

namespace sunload {

/// Corners of a triangle as indices into a table of vertices.
using Corners = std::array<std::int32_t, 3>;

/// What a split does about the vertex that it leaves in the middle of a neighbour's edge.
enum class TVertices { keep, remove };

/// An edge by its two vertices, the smaller index first.
using Edge = std::pair<std::int32_t, std::int32_t>;

inline Edge edge_opposite(const Corners& c, std::uint8_t apex) {
  return std::minmax(c[(apex + 1u) % 3], c[(apex + 2u) % 3]);
}

/// Corner opposite of the longest edge. Of equal edges that counts as longer whose ends come first
/// in the order of x, y, z: both triangles at an edge decide alike, and so does the same triangle
/// among other objects, whatever its vertices' numbers.
std::uint8_t apex_of_longest_edge(const std::vector<Vec3>& vertices, const Corners& c);

/// The two halves: (p, m, r) and (m, q, r) for the corners p, q, r after the apex and m = midpoint.
std::array<Corners, 2> halves(const Corners& c, std::uint8_t apex, std::int32_t midpoint);

}  // namespace sunload
