// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Warnings of bodies that stand above the ground.
#pragma once

#include "geo/mesh/feet.h"
#include "io/plan/scene_build.h"

namespace sunload {

/// Warns of feet that the ground does not reach, and of walls that were drawn far to reach it. In a
/// scene that gets no ground, unless the study wants none, of bodies whose feet end above the land
/// of its files: of those that come near it somewhere (others may be canopies), and of those as
/// high as a storey that a step of `scene.edit` has put there. To be called once bodies and kinds
/// of surfaces are known, before materials.
void warn_of_gaps(const Study& study, SceneKind kind, BuiltScene& built);

}  // namespace sunload
