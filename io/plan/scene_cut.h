// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Faces cut along the ends of selections, so that rules give materials to just what these hold.
#pragma once

#include <string>

#include "io/plan/scene_build.h"

namespace sunload {

/// Cuts faces along the heights and the areas of each selection of `scene.cut`: those that it would
/// choose wherever they lay, and with them triangles that share their edges (geo/mesh/cut_faces.h).
/// Adds a note of how many were cut. Throws InputError as Selector does.
void cut_at_selections(const SceneStudy& study, BuiltScene& built);

/// Whether where they are cut depends on where north is: by azimuths, or names of facades.
bool are_cut_by_north(const SceneStudy& study);

/// A warning where rules of `scene.assign` give whole triangles in place of a selection that ends
/// within them, and `scene.cut` does not name it; empty where none does.
std::string uncut_warning(const SceneStudy& study, const BuiltScene& built);

}  // namespace sunload
