// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Scene files of every format: one entry, one table of formats.
#pragma once

#include <optional>
#include <string>

#include "geo/mesh/mesh.h"
#include "io/scene/base/file_rules.h"

namespace sunload {

/// Reads a scene file; its format is told by its content, then by its extension.
///
/// Coordinates come out in metres with z up ('y' turns (x, y, z) → (x, −z, y),
/// 'x' turns (x, y, z) → (y, z, x)), absolute, in double. What was counted,
/// tolerated or left out is in `PolygonModel::notes`.
/// Throws InputError where the file is missing, of an unknown format, or wrong.
PolygonModel read_scene_file(const std::string& path, const SceneFileRules& rules);

/// What a format holds. Meshes carry no position on Earth.
enum class SceneFileKind { mesh, city, raster, plan };

/// What is known of a scene file by its name alone.
struct SceneFormat {
  SceneFileKind kind;
  bool says_up;  ///< whether the format itself tells which axis points up
};

/// By the extension, in capitals or not; nothing where it is that of no scene format. The file need
/// not be there.
std::optional<SceneFormat> scene_format_of_name(const std::string& path);

/// Whether it is plan data: footprints, which may stand on a terrain.
bool is_of_footprints(const std::string& path);

}  // namespace sunload
