// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/overlap.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "geo/mesh/box_tree.h"

namespace sunload {

double overlap_m2(const std::array<Vec3, 3>& a, Vec3 normal, const std::array<Vec3, 3>& b) {
  std::vector<Vec3> polygon(b.begin(), b.end());
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 from = a[k];
    const Vec3 inward = cross(normal, a[(k + 1) % 3] - from);
    std::vector<Vec3> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
      const double of_p = dot(inward, p - from), of_q = dot(inward, q - from);
      if (of_p >= 0) kept.push_back(p);
      if ((of_p < 0) != (of_q < 0)) kept.push_back(p + (q - p) * (of_p / (of_p - of_q)));
    }
    polygon = std::move(kept);
  }
  Vec3 twice{0, 0, 0};
  for (std::size_t i = 2; i < polygon.size(); ++i)
    twice = twice + cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return norm(twice) / 2;
}

namespace {

/// Of the scene's diagonal: eight roundings to float.
constexpr double same_place = 1e-6;
/// Of the smaller triangle: less is an edge in common.
constexpr double least_share = 1e-6;

struct Facing {
  std::array<Vec3, 3> corner;
  Vec3 normal;
  double area_m2 = 0;
};

Facing facing(const Mesh& mesh, std::size_t t) {
  const Vec3 area = mesh.area_vector2(t);
  const double length = norm(area);
  return {{mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)},
          length > 0 ? area / length : Vec3{},
          length / 2};
}

bool lies_in(const Facing& a, const Facing& b, double within_m) {
  if (dot(a.normal, b.normal) <= 0) return false;
  for (const Vec3 corner : b.corner)
    if (std::abs(dot(a.normal, corner - a.corner[0])) > within_m) return false;
  return true;
}

}  // namespace

Doubled find_doubled(const Mesh& mesh) {
  const Box all = bounding_box(mesh.vertices);
  const double within_m = same_place * norm(all.high - all.low);
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
      if (area <= least_share * std::min(t.area_m2, facings[u].area_m2)) return;
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
