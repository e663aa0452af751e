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

/// Whether a semantic surface is of a room: walls of rooms say so; floors and ceilings are where
/// their object has such walls (else some files call terraces and undersides so).
enum class OfRoom { no, beside_walls_of_rooms, yes };

/// What a semantic surface is for light; no `kind`: nothing, light passes.
struct SemanticSurface {
  std::optional<Surface> kind = Surface::other;
  bool is_known = true;
  OfRoom of_room = OfRoom::no;
};
/// Whether surfaces of rooms are to be left out beside these: there are some, and a house around
/// them.
template <class Surfaces, class SemanticOf>
bool has_rooms_inside(const Surfaces& surfaces, const SemanticOf& semantic_of) {
  bool has_rooms = false, has_house = false;
  for (const auto& one : surfaces) {
    const SemanticSurface& semantic = semantic_of(one);
    has_rooms |= semantic.of_room == OfRoom::yes;
    has_house |= semantic.kind == Surface::wall || semantic.kind == Surface::roof;
  }
  return has_rooms && has_house;
}
/// For notes.
inline constexpr const char* surfaces_of_rooms_left_out =
    "surfaces of rooms left out: they lie inside of houses";

/// WallSurface and Door are walls, RoofSurface roof, Window window, TrafficArea, WaterSurface and
/// their like ground, GroundSurface and WaterGroundSurface floor, others `other`.
SemanticSurface semantic_surface(std::string_view surface_type);

}  // namespace sunload
