// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A horizontal plate under the scene.
#pragma once

#include "geo/mesh/mesh.h"

namespace sunload {

/// Appends an object `ground` (ground_2, … where the name is taken): two
/// triangles at the lowest z of the mesh, facing up, `margin_m` wider than its
/// bounding box on each side, of kind ground and of the file material `ground`
/// (the file's own where it has one). Throws InputError for a margin that is
/// not a finite number >= 0 or leaves the plate without area.
void add_ground_plate(Mesh& mesh, double margin_m);

}  // namespace sunload
