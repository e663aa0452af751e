// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Walls that go on below a wide open sheet: houses that are sunk into a terrain which nothing says
/// is land, so that what lies below it is lit from beneath.
#pragma once

#include <string>

#include "geo/mesh/orient.h"

namespace sunload {

/// All such walls, taken together.
struct SunkWalls {
  double area_m2 = 0;  ///< of what lies below, as high as the sheet is at the foot of a triangle
  std::string sheet;   ///< object that most of it lies below
  std::string wall;    ///< object with most of it
};

/// A sheet counts where it looks up, is neither ground nor roof nor of any type that a city model
/// gives, and reaches beyond the wall's body on all sides, which stands out of it: balconies and
/// leaves do not. It has no walls of its own, and nothing stands below it, as under a roof. `mesh`
/// has its kinds of surface. Cost: a look at what is above each wall.
SunkWalls find_sunk_walls(const Mesh& mesh, const Bodies& bodies);

}  // namespace sunload
