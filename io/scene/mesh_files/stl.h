// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// STL triangle files.
#pragma once

#include <string>

#include "geo/mesh/mesh.h"
#include "io/scene/base/file_rules.h"

namespace sunload {

/// Reads text and binary STL; a file is binary where its length is what its count of
/// triangles asks for, whatever it begins with (some write `solid` into the binary header).
/// Points that are equal to the last bit become one vertex. Every `solid` of a text file is an
/// object of its name; the others have the name of the file's stem. Normals are passed over:
/// the front is where the corners run counter-clockwise. z is up unless the rules say otherwise.
///
/// Throws InputError with file:line:column (text) or the triangle's number (binary).
/// Reference: 3D Systems (1989), Stereolithography Interface Specification.
PolygonModel read_scene_stl(const std::string& path, const SceneFileRules& rules);

}  // namespace sunload
