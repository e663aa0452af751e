// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Scenes as CityJSON 2.0.
#pragma once

#include <string>

#include "geo/mesh/mesh.h"

namespace sunload {

/// Writes `path` aside first and then renames it.
///
/// One CityObject per object of the model: a Building with a Solid where its polygons close
/// (every edge is walked once each way), else a GenericCityObject with a MultiSurface; of the type
/// that the model gives, where one stands alone; parts and installations of buildings, bridges and
/// tunnels keep theirs where what they belong to is written with them: an object, or one of which
/// no surface was read, without geometry. LoD 2.
/// Kinds of surface as semantics where CityJSON has a name for them, materials with their
/// reflectance as grey diffuseColor. Coordinates in the unit of the model's CRS,
/// which is `crs_unit_m` long, rounded to micrometres. CityJSON has no mirrors and no emitters.
/// Throws MachineError where the file cannot be written.
void write_cityjson(const PolygonModel& model, const std::string& path, double crs_unit_m = 1);

}  // namespace sunload
