// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Triangles divided along planes, so that what lies on either side can be told apart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "geo/base/units.h"
#include "geo/mesh/mesh.h"
#include "geo/mesh/orient.h"

namespace sunload {

/// A plane, or what of it lies between two ends.
struct FacePlane {
  Vec3 normal{0, 0, 1};  ///< unit
  double offset = 0;     ///< dot(normal, p) of its points [m]
  /// A triangle is cut that meets it between `from` and `to` along `along` (unit, in the plane).
  Vec3 along{0, 0, 0};
  double from = -infinity, to = infinity;
};
/// Where a triangle is to be cut, by its number before any cut was made.
using PlaneOfFace = std::function<FacePlane(std::size_t)>;

/// Triangles that were divided, and those that share an edge with them.
struct FaceParts {
  Mesh mesh;                        ///< of their parts alone, but of all vertices and names
  std::vector<std::size_t> source;  ///< what each part is (a part of), in the order of these
  /// Triangles of which there is more than one part.
  std::vector<std::uint8_t> is_divided;
};

/// Divides some triangles along planes, one plane after the other, from rim to rim. Triangles that
/// share an edge which is divided are divided with it: closed bodies stay closed. Corners nearer to
/// a plane than surfaces touch (geo/mesh/covers.h) lie in it. Parts have all that is known of their
/// triangle. Cost: a look of each plane at all of `faces`, and at the parts for each cut.
FaceParts parts_of_faces(const Mesh& mesh, std::span<const std::size_t> faces,
                         std::span<const PlaneOfFace> planes);

/// The same in the mesh itself, where parts take the place of their triangle in the order. Returns
/// what each triangle is (a part of). Where nothing is cut, nothing changes.
std::vector<std::size_t> cut_faces(Mesh& mesh, Bodies& bodies, std::span<const std::size_t> faces,
                                   std::span<const PlaneOfFace> planes);

}  // namespace sunload
