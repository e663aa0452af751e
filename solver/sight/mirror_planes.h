// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Mirrors of one orientation by the planes in which they lie.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/sight/flat_polygon.h"
#include "solver/surface/mirror_groups.h"

namespace sunload {

/// Triangles of one plane and material that are a convex mirror together.
struct MirrorFace {
  std::vector<Vec3> corners;  ///< up to SunFaces::most_corners
  std::vector<std::int32_t> triangles;
  /// Others of its plane that lie in the same place, and count before it.
  std::vector<std::uint32_t> covered_by;
  bool is_screen;  ///< some light passes it
};

/// Mirrors of one plane.
struct MirrorPlane {
  HalfSpace before;  ///< where they reflect
  std::vector<MirrorFace> faces;
};

class MirrorPlanes {
 public:
  /// Planes are told apart where they are further than `flat_m` from each other.
  MirrorPlanes(const MirrorGroups& groups, double flat_m);
  /// Of a group of mirrors.
  const std::vector<MirrorPlane>& of_group(std::size_t group) const { return planes_[group]; }

 private:
  std::vector<std::vector<MirrorPlane>> planes_;
};

}  // namespace sunload
