/// Corners that lie on a neighbour's edge become corners of the neighbour.
#pragma once

#include "geo/mesh.h"

namespace sunload {

/// Splits triangles at corners of open edges of the same object that lie within
/// `tolerance` of one of their own open edges (an odd number of uses), away
/// from its ends. No vertex moves. Returns the number of such corners.
/// Expected time n·sqrt(n) in the open edges of one object.
std::size_t split_t_joints(Mesh& mesh, double tolerance);

}  // namespace sunload
