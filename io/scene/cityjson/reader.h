// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// CityJSON 1.0, 1.1, 2.0 and CityJSONSeq.
#pragma once

#include <string>

#include "geo/mesh/mesh.h"
#include "io/scene/base/file_rules.h"

namespace sunload {

/// Reads the city objects of a CityJSON file or of a sequence of CityJSONFeature lines.
///
/// - Objects are named by their ids, in the order of the ids (features: of the lines);
///   those without polygons are left out, as are vertices that no polygon uses.
/// - **Levels of detail are never stacked.** Of each object only geometries of one level are
///   read: the highest, or the one asked for ("2" is any 2.x; where an object has it not,
///   the nearest below, else above). Where a building and its parts end up with different
///   levels, only the side with the better one is read; with equal levels they complete each
///   other. The geometry of a CityObjectGroup repeats its members: read only if these have none.
/// - Semantic surfaces: WallSurface and Door are walls, RoofSurface roof, Window window,
///   TrafficArea, WaterSurface and their like ground, GroundSurface and WaterGroundSurface
///   floor; others by their slope. ClosureSurface and its like are no matter and left out.
///   Without semantics surfaces of land use, roads, railways, relief, water bodies and plant
///   cover are ground, unless the geometry is a solid.
/// - Families by `parents` or `children`, whichever is there; of several that an object belongs to
///   the first that is no CityObjectGroup. Objects without polygons are known as bare ones.
/// - Rooms, storeys, furniture and other interior objects are left out.
/// - Materials: the file's default theme, else the first in alphabetical order; diffuse
///   reflectance is the mean of diffuseColor; specularColor is a highlight, no mirror.
/// - Types that are not in the specification are read as any other object and counted.
///
/// Throws InputError for versions before 1.0 and for everything that contradicts the
/// specification in a way that makes the geometry doubtful, naming object and surface.
/// Reference: Ledoux et al. (2019), CityJSON: a compact and easy-to-use encoding of the
/// CityGML data model; CityJSON specifications 1.0.3, 1.1.3, 2.0.1.
PolygonModel read_scene_cityjson(const std::string& path, const SceneFileRules& rules);

}  // namespace sunload
