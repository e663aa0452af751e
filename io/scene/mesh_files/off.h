// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// OFF polygon files of Geomview.
#pragma once

#include <string>

#include "geo/mesh/mesh.h"
#include "io/scene/base/file_rules.h"

namespace sunload {

/// Reads the text form of OFF, COFF, NOFF, STOFF …: coordinates in double, polygons of any
/// number of vertices, comments anywhere; normals, colours and texture coordinates are passed
/// over. The object has the name of the file's stem. z is up unless the rules say otherwise.
///
/// Throws InputError with file:line:column for broken numbers, indices out of range, files
/// that are cut off, and for the binary and the four-dimensional form.
/// Reference: Geomview manual, section 4.2.5, OFF files.
PolygonModel read_scene_off(const std::string& path, const SceneFileRules& rules);

}  // namespace sunload
