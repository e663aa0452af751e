// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Fronts and backs: closed bodies turned outward, sheets made consistent.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "geo/mesh/mesh.h"

namespace sunload {

/// Whether a surface of that area has a volume within; less is a sheet folded onto itself (1 m² of
/// it 1 nm thick).
inline bool encloses(double volume_m3, double area_m2) {
  constexpr double least_volume = 1e-9;  // of area^1.5
  return volume_m3 > least_volume * std::pow(area_m2, 1.5);
}

/// keep: only find bodies, with the winding of the file. turn: change it.
enum class Winding { keep, turn };

/// Triangles of one object that are joined over edges with an even number of
/// uses: two, or more where bodies touch (geo/mesh/facing_links).
struct Body {
  ObjectId object;
  bool is_closed = false;      ///< every edge is walked as often up as down
  double area = 0;             ///< m²
  double volume = 0;           ///< m³, signed, of closed bodies: negative for cavities
  bool is_inside_out = false;  ///< closed, in no other body, negative volume: a room (`keep` only)
  bool is_inner = false;       ///< faces between the cells of another body
  Box box;
};

/// The bodies of a mesh, and counts of what their edges are like.
struct Bodies {
  std::vector<Body> bodies;                 ///< in the order of their first triangle
  std::vector<std::int32_t> triangle_body;  ///< -1: part of no body (a merged front and back)
  std::size_t triangles_flipped = 0;
  std::size_t inside_out = 0;         ///< closed, outermost and with negative volume (`keep` only)
  std::size_t unorientable = 0;       ///< no winding satisfies all edges: left as in the file
  std::size_t open_edges = 0;         ///< with one use
  std::size_t nonmanifold_edges = 0;  ///< with more than two uses

  /// Whether a triangle is of a closed body.
  bool is_closed(std::size_t t) const {
    const auto b = triangle_body[t];
    return b >= 0 && bodies[static_cast<std::size_t>(b)].is_closed;
  }
  /// Whether a triangle is a face between the cells of a body.
  bool is_inner(std::size_t t) const {
    const auto b = triangle_body[t];
    return b >= 0 && bodies[static_cast<std::size_t>(b)].is_inner;
  }
};

/// Which triangles at an edge must agree: geo/mesh/facing_links. Edges with an odd number of uses
/// say nothing, and bodies with such edges are open.
///
/// `turn`: an open body gets the winding that the larger part of its area has
/// in the file. A closed body is turned outward (positive volume); a closed
/// body inside another one of the same object, a cavity, keeps the winding that
/// it has in the file relative to the body around it.
///
/// With `turn` faces between the cells of a divided body, and what goes on beyond a body (eaves),
/// are no part of it but bodies of their own (geo/mesh/apart_faces), open ones; the latter look
/// where the body looks that they go on from.
///
/// Where `faced_both_ways` is not 0 a front and a back share the triangle. It
/// belongs to a body only if that body is closed by it: else it is left out and
/// the rest is oriented without it (two cells that share a wall).
Bodies orient(Mesh& mesh, const std::vector<std::uint8_t>& faced_both_ways, Winding winding);

}  // namespace sunload
