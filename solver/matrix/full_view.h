// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Whether two surfaces are in full view of each other: a proof, never a guess.
#pragma once

#include <span>
#include <vector>

#include "geo/mesh/mesh.h"

namespace sunload {

class FullView {
 public:
  /// Every triangle of the mesh may stand between; `mesh` must outlive it.
  explicit FullView(const Mesh& mesh);

  /// True only where no triangle reaches into the convex hull of the two convex polygons, each
  /// wholly in front of the other's plane (unit normals). Triangles that touch it do not matter.
  bool is_proved(std::span<const Vec3> from, Vec3 from_normal, std::span<const Vec3> to,
                 Vec3 to_normal) const;

 private:
  struct Triangle {
    Vec3 low, high;  ///< box
    Vec3 corner[3];
    Vec3 normal;
  };
  std::vector<Triangle> triangles_;
  double touch_m_ = 0;  ///< what reaches in by less touches only
};

}  // namespace sunload
