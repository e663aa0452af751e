// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Corners that lie on a neighbour's edge become corners of the neighbour.
#pragma once

#include <string>

#include "geo/mesh/mesh.h"

namespace sunload {

/// All of them; or those of triangles that then hang together without an open edge, but for lower
/// edges of walls: houses, also such without a floor, whose faces have corners of their own.
enum class TJoints { all, that_close };

/// Splits triangles at corners of open edges of the same object that lie within
/// `tolerance` of one of their own open edges (an odd number of uses), away
/// from its ends. No vertex moves, a face may get folds as small. Returns the number of such
/// corners. Time n·log(n) in the open edges of one object where these are short, n·sqrt(n) where
/// all are as long as it is wide. Where so many triangles overlap that it would be n², `all` throws
/// InputError, with the name of the file `source`, and `that_close` splits nothing.
std::size_t split_t_joints(Mesh& mesh, double tolerance, const std::string& source,
                           TJoints which = TJoints::all);

}  // namespace sunload
