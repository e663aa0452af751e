// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The ground that a scene gets: through the feet of its bodies, or level.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "geo/mesh/feet.h"
#include "geo/mesh/mesh.h"
#include "geo/mesh/orient.h"

namespace sunload {

/// feet: through the lower edges of walls, the land between interpolated. level: a plate.
enum class GroundSurface { feet, level };

/// The ground that is asked for.
struct GroundRules {
  double margin_m = 50;  ///< beyond the bounding box of the scene, on each side
  GroundSurface surface = GroundSurface::feet;
  std::optional<double> height_m = {};  ///< of a level ground, in the model's z; absent: its lowest
};

/// Walls that end above the terrain are drawn down by no more than this; a larger gap is told.
inline constexpr double longest_drawn_m = 5;
/// Above a gap like this one sees light below a wall, and is told.
inline constexpr double floating_m = 0.3;
/// Feet that differ by no more are level, and a ground through them is a plate.
inline constexpr double level_feet_m = 1e-3;  // city models are written in whole millimetres

/// How far an object's lower edges are from the ground: above it where positive.
struct FootGap {
  std::string object;
  double gap_m = 0;
};

/// The ground as it was made, and how bodies stand on it.
struct GroundReport {
  GroundSurface surface = GroundSurface::feet;
  bool is_level = false;         ///< asked for, or as all feet are
  double low_m = 0, high_m = 0;  ///< heights of what was made, in the model's z
  double steepest_beyond = 0;    ///< tangent: how it goes on beyond the outermost feet, at most
  double made_m2 = 0, terrain_m2 = 0;  ///< area in plan: made, and the model's own
  std::size_t standing = 0;            ///< bodies with feet
  std::size_t on_others = 0;           ///< bodies that stand on other bodies: no feet
  static constexpr std::array<double, 5> shares{0, 0.05, 0.5, 0.95, 1};
  std::array<double, 5> gap_m{};  ///< quantiles over standing bodies of their largest gap
  std::size_t drawn = 0;          ///< bodies whose walls were drawn down to the terrain
  double longest_drawn_m = 0;     ///< by so much at most
  /// Objects that nothing says are houses (signs, bridges?), drawn by more than `floating_m`: the
  /// longest first.
  std::vector<FootGap> drawn_far;
  std::size_t floating = 0;    ///< bodies more than `floating_m` above it
  std::vector<FootGap> worst;  ///< at most ten, the largest |gap| first
  /// All that no ground goes through, by more than `floating_m`, likewise.
  std::vector<FootGap> hovering;
};

/// Where bodies stand before the ground is there: what `decide_surfaces` asks.
struct Standing {
  std::optional<double> level_z;        ///< of a plate, in the mesh's z
  std::vector<std::uint8_t> on_ground;  ///< per body: the ground will go through its feet
  std::vector<std::uint8_t> on_body;    ///< per body: it stands on another one, perhaps in part
  /// surely: what hovers, and bridges and installations, such as balconies; perhaps: what is no
  /// building and has no foot, a canopy or a plate.
  enum class Hangs : std::uint8_t { no, perhaps, surely };
  std::vector<Hangs> hangs;  ///< per body, of cities
};
/// Without rules nobody stands on a ground.
Standing standing_on(const Mesh& mesh, const Bodies& bodies, const std::vector<Foot>& feet,
                     const std::optional<GroundRules>& rules);

/// What add_ground has made.
struct GroundMade {
  GroundReport report;
  /// Per triangle 1: a wall drawn down, or a floor that such walls or the terrain close. No light
  /// reaches land under such a floor, nor between one and what stands on it. Empty where there are
  /// none.
  std::vector<std::uint8_t> seals;
};

/// Appends an object `ground` (ground_2, … where the name is taken) of kind ground and of the file
/// material `ground` (the file's own where it has one), facing up.
///
/// The terrain of the model (open land of kind ground) goes first: nothing is made where it lies,
/// and what is made begins at its rim. Elsewhere lower edges of walls are constraints of a Delaunay
/// triangulation in plan; where several meet the highest counts, so that no wall ends above the
/// ground. Beyond the outermost of them the ground goes on by their slope, where they lie on a
/// plane, else level, to the margin (geo/mesh/land). What lies under a standing body is covered.
///
/// Where a wall ends above the terrain, it is drawn down: triangles of its object and material,
/// which end a little below the land, so that the land under the body can be told from the land
/// beside it. They are appended, too, so that triangles are no longer ordered by object.
///
/// Throws InputError for a margin that is not a finite number >= 0 or leaves the ground without
/// area.
GroundMade add_ground(Mesh& mesh, const std::vector<Foot>& feet, const GroundRules& rules);

}  // namespace sunload
