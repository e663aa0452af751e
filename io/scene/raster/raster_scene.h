// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// One height raster as a terrain; io/scene/blocks has buildings and crowns.
#pragma once

#include <string>

#include "geo/mesh/mesh.h"
#include "io/scene/base/file_rules.h"

namespace sunload {

/// Reads the first band of a GeoTIFF or ESRI ASCII raster as a terrain of triangles.
///
/// - Vertices are the middles of cells at their heights (band scale and offset applied); every
///   four neighbours make two triangles, divided along the diagonal that climbs less; fronts
///   look up. Steps, as at the walls of a surface model, become slopes one cell wide.
/// - Cells without data (NODATA or NaN) are left out and counted; three neighbours with data
///   make one triangle.
/// - `PolygonModel::crs` is the file's CRS, as `EPSG:…` or as WKT. CRSs in degrees are refused.
/// - The object has the name of the file's stem.
///
/// Throws InputError as `read_raster`.
PolygonModel read_scene_raster(const std::string& path, const SceneFileRules& rules);

}  // namespace sunload
