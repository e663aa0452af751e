// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/overlap.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geo/mesh/box_tree.h"
#include "geo/mesh/clip.h"

namespace sunload {

std::vector<Vec3> overlap(const std::array<Vec3, 3>& a, Vec3 normal, const std::array<Vec3, 3>& b) {
  std::vector<Vec3> polygon(b.begin(), b.end());
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 inward = cross(normal, a[(k + 1) % 3] - a[k]);
    polygon = clipped(polygon, [&](Vec3 p) { return dot(inward, p - a[k]); });
  }
  return polygon;
}

double overlap_m2(const std::array<Vec3, 3>& a, Vec3 normal, const std::array<Vec3, 3>& b) {
  return norm(area_vector2(overlap(a, normal, b))) / 2;
}

namespace {

/// Of the smaller triangle: less is an edge in common.
constexpr double least_overlap = 1e-6;

struct Facing {
  std::array<Vec3, 3> corner;
  Vec3 normal;
  double area_m2 = 0;
};

Facing facing(const Mesh& mesh, std::size_t t) {
  const Vec3 area = mesh.area_vector2(t);
  const double length = norm(area);
  return {mesh.corners(t), length > 0 ? area / length : Vec3{}, length / 2};
}

bool lies_in(const Facing& a, const Facing& b, double within_m) {
  if (dot(a.normal, b.normal) <= 0) return false;
  for (const Vec3 corner : b.corner)
    if (std::abs(dot(a.normal, corner - a.corner[0])) > within_m) return false;
  return true;
}

}  // namespace

double same_place_m(const Mesh& mesh) {
  constexpr double ratio = 1e-6;  // eight roundings to float
  const Box all = bounding_box(mesh.vertices);
  return ratio * norm(all.high - all.low);
}

Doubled find_doubled(const Mesh& mesh) {
  const double within_m = same_place_m(mesh);
  std::vector<std::size_t> triangle;
  std::vector<Facing> facings;
  std::vector<Box> boxes;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!mesh.bears_patches(t)) continue;
    triangle.push_back(t);
    facings.push_back(facing(mesh, t));
    const auto& c = facings.back().corner;
    boxes.push_back(widened(box_around({c[0], c[1], c[2]}), within_m));
  }
  const BoxTree tree(boxes);
  Doubled doubled;
  for (std::size_t i = 0; i < triangle.size(); ++i) {
    const Facing& t = facings[i];
    if (t.area_m2 == 0) continue;
    std::size_t nearest = i;
    double most_m2 = 0;
    tree.visit_meeting(boxes[i], [&](std::size_t u) {
      if (u >= i || !lies_in(facings[u], t, within_m) || !lies_in(t, facings[u], within_m)) return;
      const double area = overlap_m2(facings[u].corner, facings[u].normal, t.corner);
      if (area <= least_overlap * std::min(t.area_m2, facings[u].area_m2)) return;
      if (area > most_m2 || (area == most_m2 && u < nearest)) nearest = u;
      most_m2 = std::max(most_m2, area);
    });
    if (most_m2 == 0) continue;
    if (doubled.area_m2 == 0) doubled.first = {triangle[nearest], triangle[i]};
    doubled.area_m2 += most_m2;
  }
  return doubled;
}

}  // namespace sunload
