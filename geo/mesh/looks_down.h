// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Open surfaces that look down where light comes from above: a terrain or a house wound the wrong
/// way round, which nothing turns, since it has no inside.
#pragma once

#include <string>

#include "geo/mesh/feet.h"
#include "geo/mesh/orient.h"

namespace sunload {

/// Objects whose open surfaces look down, taken together.
struct LooksDown {
  std::size_t objects = 0;
  double area_m2 = 0;   ///< of the plan of what looks down
  std::string largest;  ///< of these objects
};

/// In city models of each object; of other models of land and of what has walls, and of others only
/// where all open surfaces together look down: rooms have ceilings that are objects. One-sided
/// triangles alone that are not upright. `mesh` has the kinds of surface that the file tells. Cost:
/// one pass.
LooksDown find_looking_down(const Mesh& mesh, const Bodies& bodies, SceneKind kind);

}  // namespace sunload
