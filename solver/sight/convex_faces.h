// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Convex polygons that opaque triangles of one plane make together: parts of walls and roofs, each
/// of which casts one shadow without a gap.
#pragma once

#include <vector>

#include "solver/sight/occluders.h"

namespace sunload {

struct ConvexFace {
  std::vector<Vec3> corners;  ///< counter-clockwise about the normal; none on a straight edge
  Vec3 normal;
  std::vector<std::uint32_t> triangles;  ///< that it is made of
};

/// Triangles joined across edges that two of them share, as long as what they make is convex and
/// flat within `flat_m`, of no more corners than that: Hertel & Mehlhorn (1983), Fast triangulation
/// of simple polygons. Every opaque triangle that has an area is in one face.
std::vector<ConvexFace> convex_faces(const Occluders& occluders, double flat_m,
                                     std::size_t most_corners);

}  // namespace sunload
