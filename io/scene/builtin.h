// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Scenes that come with the program, by name.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "geo/mesh/mesh.h"

namespace sunload {

/// Keys and values as the study or the command line states them.
struct BuiltinRules {
  std::string name;
  std::map<std::string, std::string> parameters;
};

/// All names, the two historic test scenes first.
std::vector<std::string> builtin_scene_names();

/// Allowed keys of a scene; empty where it has none. Throws InputError for an unknown name.
std::vector<std::string> builtin_parameters(const std::string& name);

/// Builds a scene: metres, z up, x east, y north, near the origin.
///
/// | scene | parameters |
/// |---|---|
/// | street | house_3: brick (default), glazed |
/// | box_on_plane | width, depth, height, plane (side of the plane) |
/// | canyon | height, width, length |
/// | room | width, depth, height |
/// | cylinder | radius, height |
/// | city | triangles: about so many, 48 … 20 000 000 (10 000) |
/// | skyscrapers, windows, emission, shadow, large_extent, complex_paths, geometric_accuracy | |
///
/// Lengths are metres, 0.1 … 10 000. Throws InputError for unknown names,
/// parameters and values, all at once, with the nearest names.
PolygonModel builtin_scene(const BuiltinRules& rules);

}  // namespace sunload
