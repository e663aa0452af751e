// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What a lifted roof leaves open, where the walls below it are not in the model.
#pragma once

#include <cstdint>
#include <vector>

#include "geo/edit/objects.h"

namespace sunload {

/// An object about to be lifted: its corners at `level_m` and above go up by `by_m`.
struct LiftedBody {
  const std::vector<LooseFace>& faces;
  std::vector<std::uint8_t> leans, is_roof;  ///< one flag per face
  double level_m, by_m;
};

/// The outline in plan of what is lifted.
struct RaisedOutline {
  double length_m = 0;  ///< in plan
  double bare_m = 0;    ///< of that, where no wall of the object goes across the level
  bool has_floor = false;
  /// Upright rings between the places of the bare rim before and after, their fronts outward; empty
  /// where the object has no floor that tells inside from outside, or is lowered.
  std::vector<std::vector<Vec3>> walls;
};

/// Party walls are in hardly any city model: roof and floor of a terraced house end in the air
/// there, and so does what is lifted. Edges of its faces are of the outline where the object has
/// something lifted and a floor on one side, and on the other nothing lifted but what is no hole
/// above the floor (a separate dormer fills those). Of edges above each other the lowest that moves
/// counts. Without a floor, rims no more than 2 m from a wall are eaves. Closed bodies have no bare
/// outline. Cost: the square of the object's edges.
RaisedOutline raised_outline(const LiftedBody& body);

}  // namespace sunload
