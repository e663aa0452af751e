// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Where bodies meet the ground: the lower edges of their walls.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "geo/mesh/mesh.h"
#include "geo/mesh/orient.h"

namespace sunload {

/// city: objects are known to be buildings, land, plants, …; plain: just shapes.
enum class SceneKind { plain, city };

/// What is this near to the lowest point of a body of this height is at its foot.
inline double foot_tolerance(double height_m) {
  constexpr double most_m = 0.1, ratio = 0.05;
  return std::min(most_m, ratio * height_m);
}

/// Land is no steeper between two feet than 45 degrees, and a step of this height.
inline constexpr double highest_step_m = 2;
/// Feet farther apart than this say nothing of each other.
inline constexpr double foot_reach_m = 30;

/// In the place of a wall that was dropped.
inline constexpr std::size_t no_wall = static_cast<std::size_t>(-1);

/// How a foot stands with regard to the ground and to other bodies.
enum class Stance {
  ground,   ///< the ground goes through the foot
  body,     ///< it stands on another body
  hovering  ///< too far above (or below) the feet beside it: a balcony, a passage, a cellar
};

/// The lower edges of one body.
struct Foot {
  std::int32_t body = -1;
  ObjectId object;
  Stance stance = Stance::ground;
  std::vector<std::array<Vec3, 2>> edges;  ///< as the walls above walk them
  std::vector<std::size_t> walls;          ///< the triangle above each edge
  std::vector<std::size_t> floors;         ///< downward triangles no higher than edges and rims
  std::vector<std::array<Vec3, 2>> rims;   ///< ends of the floors where no wall stands on them
  Box box;                                 ///< of the edges
  double plan_m2 = 0;                      ///< of what looks up or down, the larger
};

/// What is lower is no house, unless its type says so.
inline constexpr double lowest_house_m = 2;
/// Whether an object of that type stands on the ground as buildings do: CityJSON 2.0.1,
/// section 2.2, and types of extensions, which begin with a plus.
bool is_building(const std::string& kind);
/// Type of what is put into the air: no ground goes through its lower edges, also in plain files.
inline constexpr const char* hanging_kind = "BuildingInstallation";

/// Feet of all bodies that have walls, but for plants and land; of a city, of its
/// buildings, and of what has no type there (of plain files) and is as high as a storey; none of
/// what hangs in the air by its type. In the order of the bodies.
///
/// A lower edge has an upright face above it, and below it a face that looks down or nothing. Of a
/// body those count that are at its foot or reached from there along lower edges (a foot on a
/// slope). Of a sheet without a roof, a single wall perhaps, the foot is that of its object.
/// Some stand on other bodies (geo/mesh/foot_supports).
/// Where the feet of two bodies are too far above each other for the land between them, the one
/// that has more area against it is taken to hover.
std::vector<Foot> find_feet(const Mesh& mesh, const Bodies& bodies, SceneKind kind);

}  // namespace sunload
