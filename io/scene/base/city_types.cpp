// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/base/city_types.h"

#include <unordered_map>
#include <unordered_set>

namespace sunload {

namespace {

using TypeSet = std::unordered_set<std::string_view>;

const TypeSet& other_types() {
  static const TypeSet types{"Building",
                             "BuildingPart",
                             "BuildingInstallation",
                             "BuildingConstructiveElement",
                             "Bridge",
                             "BridgePart",
                             "BridgeInstallation",
                             "BridgeConstructionElement",
                             "BridgeConstructiveElement",
                             "CityFurniture",
                             "CityObjectGroup",
                             "GenericCityObject",
                             "OtherConstruction",
                             "SolitaryVegetationObject",
                             "Tunnel",
                             "TunnelPart",
                             "TunnelInstallation",
                             "TunnelConstructiveElement"};
  return types;
}

}  // namespace

bool is_terrain(std::string_view object_type) {
  static const TypeSet types{"LandUse",  "Road",      "Railway",   "TransportSquare",
                             "Waterway", "TINRelief", "WaterBody", "PlantCover"};
  return types.contains(object_type);
}

bool is_interior(std::string_view object_type) {
  static const TypeSet types{"BuildingRoom",      "BuildingStorey", "BuildingUnit",
                             "BuildingFurniture", "BridgeRoom",     "BridgeFurniture",
                             "TunnelHollowSpace", "TunnelFurniture"};
  return types.contains(object_type);
}

bool is_city_object_type(std::string_view object_type) {
  return is_terrain(object_type) || is_interior(object_type) || other_types().contains(object_type);
}

SemanticSurface semantic_surface(std::string_view surface_type) {
  static const std::unordered_map<std::string_view, SemanticSurface> table{
      {"WallSurface", {Surface::wall}},
      {"Door", {Surface::wall}},
      {"RoofSurface", {Surface::roof}},
      {"Window", {Surface::window}},
      {"GroundSurface", {Surface::floor}},
      {"WaterGroundSurface", {Surface::floor}},
      {"WaterSurface", {Surface::ground}},
      {"TrafficArea", {Surface::ground}},
      {"AuxiliaryTrafficArea", {Surface::ground}},
      {"TransportationMarking", {Surface::ground}},
      {"TransportationHole", {Surface::ground}},
      {"OuterCeilingSurface", {Surface::other}},
      {"OuterFloorSurface", {Surface::other}},
      {"InteriorWallSurface", {Surface::other, true, OfRoom::yes}},
      {"CeilingSurface", {Surface::other, true, OfRoom::beside_walls_of_rooms}},
      {"FloorSurface", {Surface::other, true, OfRoom::beside_walls_of_rooms}},
      {"ClosureSurface", {std::nullopt}},
      {"WaterClosureSurface", {std::nullopt}}};
  const auto found = table.find(surface_type);
  return found == table.end() ? SemanticSurface{Surface::other, false} : found->second;
}

}  // namespace sunload
