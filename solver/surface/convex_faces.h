// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Convex polygons that opaque triangles of one plane make together: parts of walls and roofs, each
/// of which casts one shadow without a gap.
#pragma once

#include <vector>

#include "solver/surface/occluders.h"

namespace sunload {

struct ConvexFace {
  std::vector<Vec3> corners;  ///< counter-clockwise about the normal
  Vec3 normal;
};

/// Triangles joined across edges that two of them share, as long as what they make is convex and
/// flat within `flat_m`: Hertel & Mehlhorn (1983), Fast triangulation of simple polygons. Every
/// opaque triangle that has an area is in one face.
std::vector<ConvexFace> convex_faces(const Occluders& occluders, double flat_m);

double area_of(const ConvexFace& face);

/// What is left of a face whose edges move inward by so much; no corners where that is nothing.
ConvexFace inset(const ConvexFace& face, double by_m);

}  // namespace sunload
