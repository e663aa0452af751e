// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Types of city objects and of their surfaces, by the names that CityJSON has for them.
///
/// References: CityJSON specification 2.0.1, sections 2.2 and 3.3; OGC 12-019, CityGML 2.0;
/// OGC 20-010, CityGML 3.0 conceptual model.
#pragma once

#include <optional>
#include <string_view>

#include "geo/mesh/mesh.h"

namespace sunload {

/// Land use, roads, water and their like: surfaces that are the ground.
bool is_terrain(std::string_view object_type);
/// Rooms, storeys, furniture: left out.
bool is_interior(std::string_view object_type);
/// A type of the specifications, inside or outside.
bool is_city_object_type(std::string_view object_type);

/// What a semantic surface is for light; no `kind`: nothing, light passes.
struct SemanticSurface {
  std::optional<Surface> kind = Surface::other;
  bool is_known = true;
};

/// WallSurface and Door are walls, RoofSurface roof, Window window, TrafficArea, WaterSurface and
/// their like ground, GroundSurface and WaterGroundSurface floor, others `other`.
SemanticSurface semantic_surface(std::string_view surface_type);

}  // namespace sunload
