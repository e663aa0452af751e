// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/plan_triangles.h"

#include <cmath>

namespace sunload {

PlanTriangles::PlanTriangles(const Mesh& mesh, std::vector<std::size_t> triangles)
    : mesh_(mesh), triangles_(std::move(triangles)) {
  std::vector<Box> boxes;
  boxes.reserve(triangles_.size());
  for (const auto t : triangles_) boxes.push_back(box_of(mesh, t));
  tree_ = BoxTree(std::move(boxes));
}

bool PlanTriangles::is_on(Vec3 p, double distance_m) const {
  bool is_near = false;
  visit_heights(p.x, p.y,
                [&](std::size_t, double z) { is_near |= std::abs(z - p.z) <= distance_m; });
  return is_near;
}

bool PlanTriangles::covers(Vec3 p) const {
  bool is_covered = false;
  visit_heights(p.x, p.y, [&](std::size_t, double) { is_covered = true; });
  return is_covered;
}

std::vector<std::size_t> land_triangles(const Mesh& mesh) {
  std::vector<std::size_t> land;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.triangle_surface[t] == Surface::ground && mesh.area_vector2(t).z > 0)
      land.push_back(t);
  return land;
}

}  // namespace sunload
