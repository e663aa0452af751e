// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Triangles that are no use to a ray: twins and slivers.
#pragma once

#include <cstdint>
#include <vector>

#include "geo/mesh/mesh.h"

namespace sunload {

/// Keeps the triangles for which `keep` is not 0, in their order; vertices stay.
void keep_triangles(Mesh& mesh, const std::vector<std::uint8_t>& keep);

/// Drops vertices that no triangle uses; the others keep their order.
void drop_unused_vertices(Mesh& mesh);

/// Per triangle the first one of its object that has the same corners, in any order.
std::vector<std::size_t> first_in_place(const Mesh& mesh);

/// Whether two triangles with the same corners face the same way.
bool looks_as(const Mesh& mesh, std::size_t a, std::size_t b);

/// Triangles that lay in the place of another one of their object.
struct Duplicates {
  std::size_t dropped = 0;
  /// Per triangle that is left: 1 where a front and a back were in the same place.
  std::vector<std::uint8_t> faced_both_ways;
};

/// Of triangles of one object with the same corners the first stays. Triangles
/// of different objects stay: bodies that touch keep their walls and close. `place`: as above.
Duplicates drop_duplicates(Mesh& mesh, const std::vector<std::size_t>& place);

/// Longest edge / shortest height; infinite for a triangle without area.
double aspect(const Mesh& mesh, std::size_t triangle);

/// Per triangle 1 where the height exceeds `least_height_ratio` of the longest
/// edge, and the area does not vanish in double precision.
std::vector<std::uint8_t> with_area(const Mesh& mesh, double least_height_ratio);

}  // namespace sunload
