// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Bodies of one object that have a face in common, which looks the same way for both: a low and a
/// high part that are both drawn from the ground on one outline, a wing in a longer one with the
/// same end wall.
#pragma once

#include <cstddef>
#include <vector>

#include "geo/mesh/mesh.h"

namespace sunload {

/// Gives such bodies corners of their own, so that each of the two has the face and they close as
/// two objects would. Returns how many have got them. `place`: see first_in_place
/// (geo/mesh/mesh_clean).
///
/// A body goes on from its faces over edges that two triangles have alone; where more meet, to the
/// one by which, with the windings of the file, its inside is least. It must close, but for feet of
/// walls, and leave closed what is left at its edges: the second copy of a face, or of an object,
/// that an exporter has written belongs to none. Cost: next to nothing where no two triangles have
/// the same corners and look the same way, else some passes over the edges of their objects; not
/// all are found where that would be more than 32 passes.
std::size_t part_bodies_that_share_faces(Mesh& mesh, const std::vector<std::size_t>& place);

}  // namespace sunload
