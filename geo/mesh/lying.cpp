// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/lying.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geo/mesh/box_tree.h"
#include "geo/mesh/surface_kind.h"

namespace sunload {

namespace {

constexpr double cos_of_one_plane = 0.99;  // 8 degrees

Vec3 middle_of(const Mesh& mesh, std::size_t t) { return mesh.point(t, 1.0 / 3, 1.0 / 3); }

/// Whether `p` is within the prism over a triangle of unit normal `n`, sides included.
bool is_over(const Mesh& mesh, std::size_t t, Vec3 n, Vec3 p) {
  for (int k = 0; k < 3; ++k) {
    const Vec3 a = mesh.corner(t, k), along = mesh.corner(t, k < 2 ? k + 1 : 0) - a;
    if (dot(cross(along, p - a), n) < -touching_m * norm(along)) return false;
  }
  return true;
}

}  // namespace

std::vector<std::uint8_t> lying_on(const Mesh& mesh, const std::vector<std::uint8_t>& some,
                                   const std::vector<std::uint8_t>& others) {
  std::vector<std::uint8_t> found(mesh.triangle_count(), 0);
  Box around;
  for (std::size_t t = 0; t < found.size(); ++t)
    if (some[t] != 0) include(around, middle_of(mesh, t));
  around = widened(around, touching_m);
  std::vector<std::size_t> near;
  std::vector<Box> boxes;
  for (std::size_t t = 0; t < found.size(); ++t) {
    if (others[t] == 0) continue;
    const Box box = box_of(mesh, t);
    if (!meet(box, around)) continue;
    near.push_back(t);
    boxes.push_back(box);
  }
  const BoxTree tree(std::move(boxes));
  for (std::size_t t = 0; t < found.size(); ++t) {
    if (some[t] == 0) continue;
    const Vec3 middle = middle_of(mesh, t), normal = mesh.normal(t);
    tree.visit_meeting(widened({middle, middle}, touching_m), [&](std::size_t i) {
      const std::size_t u = near[i];
      const Vec3 n = mesh.normal(u);
      if (std::abs(dot(n, normal)) >= cos_of_one_plane &&
          std::abs(dot(n, middle - mesh.corner(u, 0))) <= touching_m && is_over(mesh, u, n, middle))
        found[t] = 1;
    });
  }
  return found;
}

}  // namespace sunload
