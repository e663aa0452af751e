// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Inventories of trees: points with columns of heights and widths of crowns (GeoJSON, GeoPackage,
/// Shapefile, FlatGeobuf), through GDAL.
#pragma once

#include <string>
#include <vector>

#include "geo/mesh/delaunay.h"
#include "io/scene/base/file_rules.h"

namespace sunload {

struct TreePoint {
  Point2 place;  ///< on the scene's map [m]
  double height_m, crown_m;
  std::string name;  ///< of its column, or its number in the file
};

struct TreePoints {
  std::vector<TreePoint> trees;
  std::vector<std::string> notes;
};

/// All trees of the file, by `rules`: every point of a layer of points; where a column `natural`
/// tells trees from other things, as in OpenStreetMap, those alone. Columns that are not named are
/// found by their usual names, which is noted. `crs`: of the scene, onto which degrees are brought;
/// empty: it has none. `unit_m`: of coordinates that are no degrees, and of lengths without a unit.
/// Throws InputError, which lists columns and the first trees concerned, for trees without height
/// or crown, for several layers of points, for coordinates of another map, and for damaged files.
TreePoints read_tree_points(const std::string& path, const TreePointRules& rules,
                            const std::string& crs, double unit_m);

}  // namespace sunload
