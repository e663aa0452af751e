// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Scenes as Wavefront OBJ with a material library beside it.
#pragma once

#include <string>
#include <vector>

#include "geo/mesh/mesh.h"
#include "geo/mesh/mesh_prepare.h"

namespace sunload {

/// The library that is written with the scene: `<path without extension>.mtl`.
std::string obj_library(const std::string& path);

/// Writes `path` and its library, each aside first and then renamed, the library first.
///
/// One `o` per object, `usemtl` per material, triangles, absolute metres, z up
/// (so it reads back with the default axes of OBJ). Reflectances as grey Kd,
/// mirrors as Ks with `illum 3`, emitters as Ke with the power in a comment.
/// OBJ has no place for kinds of surface: on reading they follow from slopes.
/// Throws MachineError where a file cannot be written.
void write_obj(const Mesh& mesh, const std::string& path);

/// The same for polygons: triangulated without any repair (OBJ has no holes). What has no area is
/// left out, or refused (InputError, nothing is written) where `repair` is `none`. Returns warnings
/// of what was left out, or has another shape.
std::vector<std::string> write_obj(const PolygonModel& model, const std::string& path,
                                   Repair repair = Repair::safe);

}  // namespace sunload
