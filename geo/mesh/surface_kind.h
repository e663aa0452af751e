// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Wall, roof, ground, floor: decided from the slope where the file is silent.
#pragma once

#include "geo/mesh/feet.h"
#include "geo/mesh/ground.h"
#include "geo/mesh/mesh.h"
#include "geo/mesh/orient.h"

namespace sunload {

/// A face no higher than this above what is below it touches it: or 0.5 % of its body's height,
/// where that is less.
inline constexpr double touching_m = 0.01;  // the joints of built-in scenes are 5 mm
inline constexpr double touching_ratio = 0.005;

/// Replaces `other` by slope; what the reader has said stays.
///
/// | body | upright | upward | downward |
/// |---|---|---|---|
/// | closed body; any body of a city | wall | roof | floor at the foot, else other |
/// | open land (terrain, roads, water, …) | ground | ground | other |
/// | plants of a city | other | other | other |
/// | house without a floor of a plain file | wall | roof | other |
/// | sheet of a plain file on walls (geo/mesh/roof_sheets) | wall | roof | other |
/// | other open sheet of a plain file | wall | other | other |
///
/// A house without a floor is open along lower edges of its walls and nowhere else, and its fronts
/// look outward.
///
/// The foot is that of the body, in cities that of the object. Floors touch the ground or another
/// body and are no patches: of a plain file a face at the foot is one only where the highest upward
/// face below it (up to the body's top, so that sunk bodies are not taken to hover) touches
/// it, or, where nothing is below, the ground that the scene will get. Without a ground it is lit
/// from below. Buildings of cities stand on the ground even where none comes with them; what may
/// hang in the air there (Standing) is asked as plain files are. Rooms, whose fronts look inward
/// (`Winding::keep`), have walls and `other`.
void decide_surfaces(Mesh& mesh, const Bodies& bodies, SceneKind kind, const Standing& standing);

}  // namespace sunload
