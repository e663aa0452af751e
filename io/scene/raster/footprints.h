// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Plan data: footprints of buildings with a column of heights (GeoJSON, GeoPackage, Shapefile),
/// through GDAL.
#pragma once

#include <string>

#include "geo/mesh/mesh.h"
#include "io/scene/base/file_rules.h"

namespace sunload {

/// Whether the file is one of footprints, by its first bytes or its ending.
bool is_footprint_file(const std::string& path, std::string_view head);

/// Every polygon becomes a closed body of the type Building, by `rules.footprints`:
///
/// - its height is that of a column, else storeys times their height, else the default;
/// - its foot stands at the height of a column, else on the lowest land below its corners, else at
///   the lowest z of the geometry, else at 0;
/// - its name is that of a column, else the number of the feature.
///
/// Columns that are not named are found by their usual names, which is noted. Degrees are projected
/// to the UTM zone of the middle of the file. Throws InputError, which lists columns and the first
/// features concerned, for footprints without height, several layers of polygons, and damaged
/// files.
PolygonModel read_scene_footprints(const std::string& path, const SceneFileRules& rules);

}  // namespace sunload
