// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Polygons with holes → triangles.
///
/// A polygon is seen along the axis nearest to its Newell normal (Sutherland,
/// Sproull, Schumacker 1974): its plane coordinates are then coordinates of the
/// file, without rounding, and points on a line stay on a line in walls and
/// slabs. The triangles keep the polygon's own corners, so that the sum of
/// their area vectors is the polygon's whatever its shape in space.
///
/// - Triangles are taken as they are, strictly convex quads are cut along the
///   diagonal with the better shaped halves, all others go to geo/mesh/delaunay.
/// - Inside is what an odd number of ring edges separates from the outside: an
///   edge walked twice (a bridge to a hole) separates nothing. Where this does
///   not give the area of the outer ring less that of the holes, each triangle
///   of the triangulation is asked instead: inside the outer ring, outside all
///   holes. Where that fails too, or rings cross (which makes new corners, put
///   in the polygon's plane), the polygon counts as `crossing`.
/// - A polygon counts as `nonplanar` where a corner is further than 1 cm, or
///   1/1000 of the polygon's width where that is less, from the plane through
///   the corners' mean.
#pragma once

#include <cstdint>
#include <vector>

#include "geo/mesh/mesh.h"

namespace sunload {

/// How many polygons were unusual.
struct TriangulationCounts {
  std::size_t with_holes = 0, nonplanar = 0, crossing = 0;
  std::size_t collapsed = 0;       ///< less than three distinct corners, or no area: dropped
  std::size_t untriangulated = 0;  ///< dropped after an error of the triangulation
};

/// Appends the triangles of all polygons to `mesh`, ordered by object, then as
/// in the file. `new_index` leads from vertices of the model to those of the mesh.
TriangulationCounts triangulate(const PolygonModel& model,
                                const std::vector<std::int32_t>& new_index, Mesh& mesh);

}  // namespace sunload
