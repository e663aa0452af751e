// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Which triangles of one object meet at an edge.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "geo/mesh/mesh.h"

namespace sunload {

/// Triangle t has the half-edges 3t + k, from its corner k to the next corner.
struct EdgeUse {
  std::int32_t object, low, high;  ///< vertices, low < high
  std::uint32_t half_edge;

  std::size_t triangle() const { return half_edge / 3; }
  std::size_t corner() const { return half_edge % 3; }
  bool same_edge(const EdgeUse& other) const {
    return object == other.object && low == other.low && high == other.high;
  }
};

/// All uses of edges by the triangles for which `included` is not 0, sorted by
/// object, edge and half-edge. An edge is shared within one object only.
std::vector<EdgeUse> edge_uses(const Mesh& mesh, const std::vector<std::uint8_t>& included);

/// Calls `visit` with the uses of each edge, in order.
template <class Visit>
void for_each_edge(const std::vector<EdgeUse>& uses, Visit visit) {
  for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
    while (end < uses.size() && uses[end].same_edge(uses[begin])) ++end;
    visit(std::span(uses).subspan(begin, end - begin));
  }
}

/// Where the triangles of one edge's uses lie about it [rad, -π … π], counter-clockwise as seen
/// from its higher vertex, from a direction of its own.
std::vector<double> angles_about(const Mesh& mesh, std::span<const EdgeUse> uses);

/// Corner of the use's triangle that is not on the edge.
inline Vec3 apex_of(const Mesh& mesh, const EdgeUse& use) {
  return mesh.corner(use.triangle(), static_cast<int>((use.corner() + 2) % 3));
}

/// Triangles whose angles about an edge differ by less lie on each other: a party wall of two
/// houses, a roof below a penthouse.
inline constexpr double same_angle = 1e-3;

/// Whether the edge is the lower one of an upright triangle that stands on it.
bool is_foot_of_wall(const Mesh& mesh, const EdgeUse& use);
/// Whether these are the feet of two walls or more that lie on each other: of houses without floors
/// that touch, of which one is longer or higher, or that lie in one another. They do not go on from
/// each other there.
bool are_feet_that_touch(const Mesh& mesh, std::span<const EdgeUse> uses);

/// True where the triangle walks the edge from its lower to its higher vertex.
inline bool walks_up(const Mesh& mesh, const EdgeUse& use) {
  return mesh.triangles[use.triangle()][use.corner()] == use.low;
}

}  // namespace sunload
