// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Triangles that cut through others: found and counted, never repaired.
#pragma once

#include <array>
#include <cstddef>

#include "geo/mesh/mesh.h"

namespace sunload {

/// Counts of pairs, each pair once.
struct Intersections {
  std::size_t cutting = 0;                 ///< pairs of triangles, each on both sides of the other
  std::size_t covering = 0;                ///< pairs in one plane that share some area
  std::size_t between_objects = 0;         ///< of both, pairs of two objects
  std::size_t triangles = 0;               ///< that are part of a pair
  std::array<std::size_t, 2> first{0, 0};  ///< the pair with the lowest indices
  std::size_t pairs() const { return cutting + covering; }
};

/// Pairs of triangles that cut or cover each other. What only touches, a wall on the ground or a
/// T-joint, is none; floors cover the ground on purpose and do not count as covering. Predicates
/// are exact (CGAL); vertices are those of the mesh, welded.
Intersections find_intersections(const Mesh& mesh);

}  // namespace sunload
