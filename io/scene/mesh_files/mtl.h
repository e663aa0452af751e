// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Material library (MTL) of an OBJ file.
#pragma once

#include <map>
#include <string>

#include "geo/mesh/mesh.h"
#include "io/scene/base/from_file.h"

namespace sunload {

/// A material of a library.
struct LibraryMaterial {
  FileMaterial material;
  bool is_transparent = false;  ///< d below 1, or without d Tr above 0: not taken
};

/// Materials by name, of what the library states and nothing else.
///
/// Diffuse reflectance: mean of Kd. Mirror reflectance: mean of Ks, only where `illum` asks
/// for reflected rays (3, 5 … 9); Ks of other materials is a highlight of Phong's model and
/// is counted in `notes`, as are textures and colours outside [0, 1].
/// Materials with Ke `glow`: Ke has no unit, so the power is the study's to tell.
/// Throws InputError for broken numbers.
/// Reference: Wavefront (1995), Advanced Visualizer manual, appendix B2.
std::map<std::string, LibraryMaterial> read_material_library(const std::string& path,
                                                             NoteCounter& notes);

}  // namespace sunload
