// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Triangles divided along planes, so that what lies on either side can be told apart.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
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
using PlaneOfFace = std::function<std::optional<FacePlane>(std::size_t)>;

/// Divides triangles along their planes, from rim to rim. Triangles that share an edge which is
/// divided are divided with it: closed bodies stay closed. Corners nearer to a plane than surfaces
/// touch (geo/mesh/covered.h) lie in it. Parts take the place of their triangle in the order, and
/// all that is known of it.
///
/// Returns what each triangle is (a part of). Where nothing is cut, nothing changes. Cost: a look
/// at all triangles, again while parts meet planes of their own.
std::vector<std::size_t> cut_faces(Mesh& mesh, Bodies& bodies, const PlaneOfFace& plane_of);

}  // namespace sunload
