// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Corners that lie on a neighbour's edge become corners of the neighbour.
#pragma once

#include <string>

#include "geo/mesh/mesh.h"

namespace sunload {

/// Splits triangles at corners of open edges of the same object that lie within
/// `tolerance` of one of their own open edges (an odd number of uses), away
/// from its ends. No vertex moves. Returns the number of such corners.
/// Time n·log(n) in the open edges of one object where these are short, n·sqrt(n) where all are as
/// long as it is wide. Throws InputError, with the name of the file `source`, where so many
/// triangles overlap that it would be n².
std::size_t split_t_joints(Mesh& mesh, double tolerance, const std::string& source);

}  // namespace sunload
