// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Surfaces that lie in one another.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "geo/mesh/mesh.h"

namespace sunload {

/// What of triangle b lies before or behind a, whose unit normal that is: b cut by the edges of a.
std::vector<Vec3> overlap(const std::array<Vec3, 3>& a, Vec3 normal, const std::array<Vec3, 3>& b);
/// Its area [m2].
double overlap_m2(const std::array<Vec3, 3>& a, Vec3 normal, const std::array<Vec3, 3>& b);

/// Triangles with patches that lie in the place of others and face the same way: each of the two
/// receives the light of one, and sends it on.
struct Doubled {
  double area_m2 = 0;
  std::array<std::size_t, 2> first{};  ///< a triangle, and one that lies in it; where there is any
};
/// Surfaces that are nearer [m] than this are in one place: the ray caster's single precision does
/// not tell them apart.
double same_place_m(const Mesh& mesh);
Doubled find_doubled(const Mesh& mesh);

}  // namespace sunload
