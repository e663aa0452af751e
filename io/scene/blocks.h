// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Rasters that belong together as a model of blocks: land, buildings and crowns of trees.
#pragma once

#include <string>

#include "geo/mesh/mesh.h"
#include "io/scene/base/file_rules.h"

namespace sunload {

/// What users of surface models (DSM, DEM, CDSM of UMEP and the like) have.
struct RasterFiles {
  std::string surface;  ///< elevations of roofs and ground (DSM)
  std::string terrain;  ///< elevations of bare ground (DEM)
  /// Heights of crowns above the ground, 0 where there is none (CDSM); or empty.
  std::string canopy;
  double least_height_m = 2;  ///< a cell is built on where surface − terrain is at least this
  double trunk_share = 0.25;  ///< of a crown's height: light passes below it freely
};

/// Cells are areas, and everything ends at their borders:
///
/// - **Land** (object `terrain`, type TINRelief, kind ground): corners of cells at the mean
///   terrain of the cells around them, two triangles per cell that is not built on.
/// - **Buildings** (`building_1` …, type Building): cells built on that share a border are one
///   closed body with a flat roof per cell at its surface's height, upright walls between cells
///   and down to the land, and floors where the land goes on beneath.
/// - **Crowns** (`crown_1` …, type SolitaryVegetationObject, material `crown` of the table or the
///   study): cells with canopy that share a border are one closed body from `trunk_share` of
///   their height to their height above the terrain, at least above the roof below.
///
/// Bodies are closed corner to corner, without T-joints. Surfaces lower than `least_height_m` are
/// taken for ground, at the terrain's height. Cells without terrain are left out, without surface
/// they are bare. Throws InputError as `read_raster`, and where grids differ.
PolygonModel read_scene_blocks(const RasterFiles& files, const SceneFileRules& rules);

}  // namespace sunload
