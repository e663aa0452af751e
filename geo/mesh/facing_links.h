// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Which triangles of a mesh must face the same way.
#pragma once

#include <cstdint>
#include <vector>

#include "geo/mesh/mesh.h"

namespace sunload {

inline constexpr std::uint32_t no_link = 0xffffffff;

/// Half-edges that must agree, and how each walks its edge in the file. Two triangles at an edge
/// agree if they walk it in opposite directions. Of 2m at an edge those of one sheet, which hang
/// together elsewhere, go on from each other where it has two there; of the others those next to
/// each other by angle must agree, since solid and void alternate, and where some lie on each
/// other, as solids that touch do, their order is the one in which sheets go on.
struct Links {
  std::vector<std::uint32_t> next;  ///< in a ring around the edge; no_link: odd edges, such feet
  std::vector<std::uint8_t> up;
  std::size_t open_edges = 0, nonmanifold_edges = 0;
};

Links link_edges(const Mesh& mesh, const std::vector<std::uint8_t>& included);

/// Bodies, and per triangle whether it must be flipped to agree with its body.
struct Grouping {
  std::vector<std::int32_t> body;
  std::vector<std::uint8_t> flip;
  std::vector<std::uint8_t> is_linked, has_conflict;  ///< per body: all edges linked; some disagree
};

Grouping group(const Mesh& mesh, const Links& links, const std::vector<std::uint8_t>& included);

}  // namespace sunload
