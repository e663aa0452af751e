// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Points of open land, the closer together the nearer lines are: triangles between lines alone
/// would be needles from house to house.
#pragma once

#include <vector>

#include "geo/mesh/box_tree.h"
#include "geo/mesh/land.h"

namespace sunload {

/// No two points are nearer to each other than that, nor to a line than half of it.
inline constexpr double finest_land_m = 2;

/// Middles of the cells of a quadtree over a rectangle around the lines: cells are as wide as the
/// next line is away, give or take a factor of 2, less than half as wide as the rectangle, and no
/// narrower than the mean length of the feet, nor than `finest_land_m`; z is 0. None where there
/// are no feet. Cost: some 2 µs for a point.
///
/// Graded as the quadtrees of Bern, Eppstein & Gilbert (1994), Provably good mesh generation, with
/// lines left whole.
std::vector<Vec3> open_land_points(const LandLines& lines, const Box& rectangle);

}  // namespace sunload
