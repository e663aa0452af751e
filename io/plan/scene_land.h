// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Objects that the study calls land: formats without types of objects cannot tell.
#pragma once

#include <string>
#include <vector>

#include "geo/mesh/mesh.h"
#include "io/study/study.h"

namespace sunload {

/// Gives the objects that `scene.land` names the type of a terrain (TINRelief): their open
/// surfaces, however steep, are ground, and what lies below is covered. Land that looks down, also
/// of types that say so, is turned over, with a note, unless the study keeps fronts or repairs
/// nothing: then it is none.
/// Throws InputError for every name that matches none.
void call_land(const SceneStudy& scene, PolygonModel& model);

/// Warns of names of `scene.land` whose objects have become no ground: closed bodies, and what
/// looks down; and of those with upright faces as of houses, which have become ground.
void warn_of_no_land(const SceneStudy& scene, const Mesh& mesh, std::vector<std::string>& warnings);

}  // namespace sunload
