// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/mesh/nearness.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sunload {

namespace {

/// Of the normal: 60° and more from level. Land may be as steep as it likes.
constexpr double steep_cosine = 0.5;

bool is_wall(const Mesh& mesh, std::size_t triangle) {
  switch (mesh.triangle_surface[triangle]) {
    case Surface::wall:
    case Surface::window:
      return true;
    case Surface::ground:
    case Surface::floor:
      return false;
    case Surface::other:
    case Surface::roof: {
      const Vec3 n = mesh.area_vector2(triangle);
      return std::abs(n.z) < steep_cosine * norm(n);
    }
  }
  return false;
}

double to_segment(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 ab = b - a;
  const double length2 = dot(ab, ab);
  const double t = length2 > 0 ? std::clamp(dot(p - a, ab) / length2, 0.0, 1.0) : 0;
  return norm(a + ab * t - p);
}

/// Of a point from a triangle: along its normal where the point is above it, else from its edges.
double to_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 n = cross(b - a, c - a);
  const bool is_above = dot(cross(b - a, p - a), n) >= 0 && dot(cross(c - b, p - b), n) >= 0 &&
                        dot(cross(a - c, p - c), n) >= 0;
  if (is_above && norm(n) > 0) return std::abs(dot(p - a, n)) / norm(n);
  return std::min({to_segment(p, a, b), to_segment(p, b, c), to_segment(p, c, a)});
}

}  // namespace

Nearness::Nearness(const Scene& scene) : scene_(scene) {
  const Mesh& mesh = scene.mesh;
  std::vector<Box> boxes;
  is_wall_.resize(mesh.triangle_count());
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    is_wall_[t] = is_wall(mesh, t);
    if (!is_wall_[t]) continue;
    walls_.push_back(t);
    boxes.push_back(box_of(mesh, t));
  }
  boxes_ = BoxTree(std::move(boxes));
}

double Nearness::distance_m(const ElementForest& forest, std::size_t element) const {
  if (walls_.empty() || is_wall_[static_cast<std::size_t>(forest.elements()[element].triangle)])
    return 0;
  Vec3 corners[3];
  for (std::size_t k = 0; k < 3; ++k) corners[k] = forest.corner(element, k);
  const Vec3 centre = (corners[0] + corners[1] + corners[2]) / 3;
  double radius = 0;
  for (const Vec3 corner : corners) radius = std::max(radius, norm(corner - centre));
  return std::max(0.0, nearest_m(centre) - radius);
}

double Nearness::nearest_m(Vec3 point) const {
  double nearest = std::numeric_limits<double>::infinity();
  boxes_.visit_near_first(
      point, [&](const Box& box) { return distance2(box, point) < nearest * nearest; },
      [&](std::size_t wall) {
        const Mesh& mesh = scene_.mesh;
        const std::size_t t = walls_[wall];
        nearest = std::min(
            nearest, to_triangle(point, mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)));
      });
  return nearest;
}

}  // namespace sunload
