// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The files of a scene, or a built-in scene, put together into one model.
#pragma once

#include <string>

#include "geo/mesh/mesh.h"
#include "io/study/file_place.h"
#include "io/study/study.h"

namespace sunload {

/// Reads what `study.scene` names and puts every file in its place.
///
/// Objects of one name in several files are kept apart, the later ones as `name_2`, and noted; so
/// are materials, which keep their names. A file that is placed no longer lies in its own CRS.
/// Throws InputError with the problems of all files.
PolygonModel read_models(const Study& study);

/// One file as the study reads it, before it is placed. Degrees of one that stays in place are
/// brought onto the scene's map, `crs`, where that is known.
PolygonModel read_part(const SceneFileStudy& file, const SceneStudy& scene, const std::string& crs);

/// Puts `from` behind `into`: see read_models() for names that both have.
void append(PolygonModel& into, const PolygonModel& from);

/// Turns and moves the model of a file, without the CRS that it had.
void place(PolygonModel& model, const FilePlace& place);

}  // namespace sunload
