// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Suns of a block that stand so close together that one look at the scene serves them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "solver/light/sun_block.h"

namespace sunload {

/// A frame across the light of a sun: x, y, and h towards the sun.
struct ViewPoint {
  double x, y, h;
};
/// Three unit axes at right angles, `to_sun` along the light; gives a place of the scene in them
/// [m].
struct ViewFrame {
  Vec3 x, y, to_sun;
  /// Some axes.
  explicit ViewFrame(Vec3 sun)
      : x(tangents(sun).tangent), y(tangents(sun).bitangent), to_sun(sun) {}
  /// x as near to `along` as it can be.
  ViewFrame(Vec3 sun, Vec3 along);
  ViewPoint operator()(Vec3 p) const { return {dot(p, x), dot(p, y), dot(p, to_sun)}; }
};

/// Suns of a block that share a view, and how far apart their light falls.
struct SunCluster {
  std::size_t first, count;  ///< consecutive ones of the block
  ViewFrame frame;           ///< across the light of their middle, x along their row
  /// How far light from any point of their disks moves along x and y, at most, for a rise of 1
  /// along the middle.
  double drift_x, drift_y;
  double lowest_sine;  ///< of their elevations
};

/// All suns of the block that are above the horizon, in their order; none farther than `widest`
/// (radians) from the middle of its cluster. Suns with a disk stand alone: what of the disk may be
/// hidden is told within bounds, which must not depend on the suns beside it.
std::vector<SunCluster> sun_clusters(std::span<const IntervalLight> block, double widest);

}  // namespace sunload
