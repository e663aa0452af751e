// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Wall, roof, ground, floor: decided from the slope where the file is silent.
#pragma once

#include "geo/mesh/mesh.h"
#include "geo/mesh/orient.h"

namespace sunload {

/// city: objects are known to be buildings, land, plants, …; plain: just shapes.
enum class SceneKind { plain, city };

/// A face steeper than this is upright.
inline constexpr double upright_slope_deg = 70;
/// Faces this near to the lowest z of a body, or 5 % of its height where that
/// is less, are at its foot.
inline constexpr double foot_height_m = 0.1;
inline constexpr double foot_height_ratio = 0.05;

/// Replaces `other` by slope; what the reader has said stays.
///
/// | body | upright | upward | downward |
/// |---|---|---|---|
/// | closed body; any body of a city | wall | roof | floor at the foot, else other |
/// | open land of a city (terrain, roads, water, …) | wall | ground | other |
/// | plants of a city | other | other | other |
/// | open sheet of a plain file | wall | other | other |
///
/// The foot is that of the body, in cities that of the object. Floors touch the
/// ground and are no patches, so a body of a plain file that hovers has none: a
/// face at its foot stays `other` where the ground is lower than the foot's
/// tolerance. The ground is the highest upward face below the face's centre (up
/// to the body's top, so that sunk bodies are not taken to hover); where nothing
/// is below, the lowest z of the scene, where a ground plate lies. Buildings of
/// cities stand on the ground even where no terrain comes with them. Rooms,
/// whose fronts look inward (`Winding::keep`), have walls and `other`.
void decide_surfaces(Mesh& mesh, const Bodies& bodies, SceneKind kind);

}  // namespace sunload
