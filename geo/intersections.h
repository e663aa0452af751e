/// Triangles that cut through others: found and counted, never repaired.
#pragma once

#include <array>
#include <cstddef>

#include "geo/mesh.h"

namespace sunload {

struct Intersections {
  std::size_t pairs = 0;                   ///< of triangles
  std::size_t triangles = 0;               ///< that are part of a pair
  std::size_t between_objects = 0;         ///< pairs of two objects
  std::array<std::size_t, 2> first{0, 0};  ///< the pair with the lowest indices
};

/// Pairs of triangles that have points in common beyond shared corners and edges: one cuts through
/// the other, touches its inside, or lies upon it. Predicates are exact (CGAL); vertices are those
/// of the mesh, welded. Light is right all the same for what is closed: hidden parts stay dark.
Intersections find_intersections(const Mesh& mesh);

}  // namespace sunload
