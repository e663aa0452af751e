// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Houses that are no closed bodies, for want of a floor or where their faces do not quite meet:
/// walls and a roof about land that no light reaches.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geo/mesh/box_tree.h"
#include "geo/mesh/orient.h"

namespace sunload {

class OpenHouses {
 public:
  /// Of objects that are neither land nor plants the opaque triangles that belong to no closed
  /// body; none where no object is land. Faces within are left out: inner faces, and of objects
  /// with houses that are open below alone what has no roof of its own (partitions). All must
  /// outlive it.
  OpenHouses(const Mesh& mesh, const Bodies& bodies, const std::vector<std::uint8_t>& is_opaque);

  /// Whether the triangle is a wall of one.
  bool is_wall(std::size_t t) const { return is_wall_[t] != 0; }
  /// Whether the triangle is a wall or roof of an object whose houses are open below alone.
  bool is_of_tight(std::size_t t) const { return is_of_tight_[t] != 0; }
  /// Whether an object has a roof above the point and walls about it: in each of the four
  /// directions along the axes an odd number. (A passage below a house has two open ends.)
  bool hold(Vec3 p) const { return holder(p).has_value(); }
  /// The same of houses that are open below alone (geo/mesh/open_below): their lowest height.
  /// Nothing where there is none.
  std::optional<double> foot_of_tight_holder(Vec3 p) const;

 private:
  std::optional<ObjectId> holder(Vec3 p) const;
  bool enclose(ObjectId object, Vec3 p) const;

  const Mesh& mesh_;
  std::vector<std::uint8_t> is_wall_, is_of_tight_;  ///< per triangle
  std::vector<Box> of_object_;
  std::vector<std::uint8_t> is_tight_;  ///< per object: its houses are open below alone
  std::vector<std::size_t> triangle_;   ///< of the tree
  BoxTree tree_;
};

}  // namespace sunload
