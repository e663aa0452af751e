// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Some triangles of a mesh to be asked by points in plan.
#pragma once

#include <utility>
#include <vector>

#include "geo/mesh/box_tree.h"
#include "geo/mesh/mesh.h"
#include "geo/mesh/slope.h"

namespace sunload {

/// The mesh must outlive it; triangles may be appended to it.
class PlanTriangles {
 public:
  PlanTriangles(const Mesh& mesh, std::vector<std::size_t> triangles);
  bool empty() const { return triangles_.empty(); }

  /// `visit(triangle, z)` of each that (x, y) lies in, or on its rim, in plan; upright ones have no
  /// height. Cost: logarithmic, and one test for each box that holds the point.
  template <class Visit>
  void visit_heights(double x, double y, const Visit& visit) const {
    tree_.visit_column(x, y, [&](std::size_t i) {
      const std::size_t t = triangles_[i];
      if (const auto z = height_at(mesh_, t, x, y)) visit(t, *z);
    });
  }
  /// One of them is no farther above or below than that.
  bool is_on(Vec3 p, double distance_m) const;
  /// One of them lies above or below.
  bool covers(Vec3 p) const;

 private:
  const Mesh& mesh_;
  std::vector<std::size_t> triangles_;
  BoxTree tree_;
};

/// Triangles of the ground that look up.
std::vector<std::size_t> land_triangles(const Mesh& mesh);

}  // namespace sunload
