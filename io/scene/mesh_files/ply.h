// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// PLY polygon files.
#pragma once

#include <string>

#include "geo/mesh/mesh.h"
#include "io/scene/base/file_rules.h"

namespace sunload {

/// Reads the elements `vertex` (x, y, z) and `face` (a list of vertex indices) of a PLY file:
/// ascii, binary little-endian or big-endian, numbers of any type, coordinates in double.
/// Other properties and elements are passed over; colours and triangle strips with a note.
/// The object has the name of the file's stem. z is up unless the rules say otherwise.
///
/// Throws InputError with file:line:column (ascii) or the element's number (binary) for a
/// broken header, a file that is cut off, indices out of range, coordinates that are none.
/// Reference: Turk (1994), The PLY Polygon File Format.
PolygonModel read_scene_ply(const std::string& path, const SceneFileRules& rules);

}  // namespace sunload
