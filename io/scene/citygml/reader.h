// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// CityGML 1.0, 2.0 and 3.0.
#pragma once

#include <string>

#include "geo/mesh/mesh.h"
#include "io/scene/base/file_rules.h"

namespace sunload {

/// Reads the city objects of a CityGML file, which may be packed by gzip. Elements are told by
/// their names, whatever their namespace: the versions differ in where things stand.
///
/// - Objects are named by their gml:id, in the order of the file, those without one by type and
///   number (`Building_1`); those without polygons are left out. Parts, installations and the like
///   are objects of their own, which belong to what they stand in. Types are those of CityJSON
///   (`Square` is `TransportSquare`).
/// - Geometry: solids, surfaces and their aggregates down to polygons, triangles and patches, by
///   `xlink:href="#id"`, too. Of an object each polygon is read once, with the semantics of the
///   boundary surface that holds it, whether by link or written again; a building leaves
///   polygons to its parts. OrientableSurface turns. Implicit geometries are placed; those of
///   library files are left out, as are points, lines and what other files hold.
/// - **Levels of detail are never stacked**, as in `read_scene_cityjson`; of lod0FootPrint and
///   lod0RoofEdge the footprint is read. Of reliefs on the same land the best level is read.
/// - Semantic surfaces and types, interior objects: as in `read_scene_cityjson`
///   (io/scene/base/city_types.h).
/// - Positions: frame.h says how the srsName and the order of axes are understood.
/// - Materials: X3DMaterial by target (appearance.h).
///
/// Throws InputError with line and column for what is no CityGML, positions of two numbers, numbers
/// that are none, positions beyond the Earth, links in circles.
/// References: OGC 08-007r1 (CityGML 1.0), OGC 12-019 (2.0), OGC 20-010 and 21-006r2 (3.0).
PolygonModel read_scene_citygml(const std::string& path, const SceneFileRules& rules);

}  // namespace sunload
