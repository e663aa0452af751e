// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Faces of a body that are none of its outside: storeys, party walls and partitions between its
/// cells, and eaves, garden walls and land that go on beyond it.
#pragma once

#include <cstdint>
#include <vector>

#include "geo/mesh/mesh.h"

namespace sunload {

/// One flag per triangle of a mesh.
struct ApartFaces {
  /// Both sides look into cells that the triangles of its object close around, so that without it
  /// the body is as closed as with it.
  std::vector<std::uint8_t> inner;
  /// Both sides look into the same part of space, which nothing encloses, beside cells of its body
  /// that are closed without it. Never land.
  std::vector<std::uint8_t> loose;
};

/// Asked of triangles that hang together where some edge has an odd number of uses, three or more:
/// there solid and void cannot alternate. Windings are not asked, but where triangles lie on each
/// other at an edge and the sheets that they are of do not tell which comes first. What lies in the
/// same place may be told so, too.
///
/// Sides of triangles that follow each other about an edge see the same part of space; all sides
/// that see one part enclose it, if the volume on their side is finite. Walls are taken to stand on
/// something: about their open lower edges their sides do not see each other. Cost: one pass, and a
/// sort about each edge with more than two uses.
ApartFaces apart_faces(const Mesh& mesh);

}  // namespace sunload
