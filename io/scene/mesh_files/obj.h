// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Wavefront OBJ with its material library.
#pragma once

#include <string>

#include "geo/mesh/mesh.h"
#include "io/scene/base/file_rules.h"

namespace sunload {

/// Reads polygons of any number of vertices, coordinates correctly rounded to double.
///
/// - Object of a face: the name of `o` in force, else of `g`, else the file's stem; the
///   same name again is the same object.
/// - Material of a face: `usemtl`. Its diffuse reflectance is the mean of Kd. Ks is as a
///   rule a highlight of Phong's model, no mirror: its mean is the mirror reflectance only
///   where `illum` asks for reflected rays (3, 5 … 9). A missing library is a note.
/// - Only vertices that faces use are kept. Lines, points and free-form shapes are counted.
/// - z is up unless the rules say otherwise.
///
/// Throws InputError with file:line:column for broken numbers, indices out of range, faces
/// of fewer than 3 vertices.
/// Reference: Wavefront (1995), Advanced Visualizer manual, appendices B1 and B2.
PolygonModel read_scene_obj(const std::string& path, const SceneFileRules& rules);

}  // namespace sunload
