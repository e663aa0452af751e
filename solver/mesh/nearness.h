// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// How near a place is to what throws shadows: people look at buildings and at the ground about
/// them, and open land far away is most of the area of many scenes.
#pragma once

#include <vector>

#include "geo/mesh/box_tree.h"
#include "solver/mesh/element_forest.h"

namespace sunload {

/// Places no further away than this from a wall are near it [m].
inline constexpr double near_m = 10;

/// A place's part in the error of a mesh: 1 near walls, falling with the distance from there.
constexpr double weight_at(double distance_m) {
  return distance_m > near_m ? near_m / distance_m : 1;
}

/// Finds the nearest wall by a tree of boxes.
class Nearness {
 public:
  /// Of walls, windows and what else is steep but land. `scene` must outlive it.
  explicit Nearness(const Scene& scene);

  bool has_walls() const { return !walls_.empty(); }

  /// From the sphere about an element to the nearest wall [m]; 0 of walls, and where the scene has
  /// none.
  double distance_m(const ElementForest& forest, std::size_t element) const;

 private:
  double nearest_m(Vec3 point) const;

  const Scene& scene_;
  std::vector<std::size_t> walls_;  ///< triangles
  std::vector<bool> is_wall_;       ///< per triangle
  BoxTree boxes_;                   ///< of `walls_`
};

}  // namespace sunload
