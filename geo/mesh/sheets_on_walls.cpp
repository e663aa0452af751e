// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/sheets_on_walls.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "geo/mesh/box_tree.h"
#include "geo/mesh/covers.h"
#include "geo/mesh/overlap.h"
#include "geo/mesh/slope.h"

namespace sunload {

namespace {

constexpr double contacts_off = 10, looked_at_share = 0.5;
/// Of two that look at each other: panes are parallel to their walls.
constexpr double most_cosine = -0.99;

/// The fronts of all closed bodies.
class SolidFronts {
 public:
  SolidFronts(const Mesh& mesh, const Bodies& bodies)
      : mesh_(mesh), near_m_(contacts_off * contact_of(mesh)) {
    std::vector<Box> boxes;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
      if (!bodies.is_closed(t) || !(mesh.area_m2(t) > 0)) continue;
      triangle_.push_back(t);
      boxes.push_back(box_of(mesh, t));
    }
    tree_ = BoxTree(std::move(boxes));
  }

  /// How much of a triangle looks at one from near [m2].
  double looked_at_m2(std::size_t t) const {
    const auto c = mesh_.corners(t);
    const Vec3 normal = mesh_.normal(t);
    double sum = 0;
    tree_.visit_meeting(widened(box_of(mesh_, t), near_m_), [&](std::size_t i) {
      const std::size_t u = triangle_[i];
      const Vec3 front = mesh_.normal(u);
      if (dot(normal, front) < most_cosine && is_before(c, mesh_.corner(u, 0), front))
        sum += overlap_m2(c, normal, mesh_.corners(u));
    });
    return sum;
  }

 private:
  bool is_before(const std::array<Vec3, 3>& corners, Vec3 of_plane, Vec3 normal) const {
    return std::ranges::all_of(corners, [&](Vec3 p) {
      const double before_m = dot(p - of_plane, normal);
      return before_m > -near_m_ / contacts_off && before_m < near_m_;
    });
  }

  const Mesh& mesh_;
  double near_m_;
  std::vector<std::size_t> triangle_;  ///< of the tree
  BoxTree tree_;
};

/// Of each body, what is looked at of it; below 0: it is none that may be turned.
std::vector<double> looked_at_of(const Mesh& mesh, const Bodies& bodies) {
  std::vector<double> looked_at(bodies.bodies.size(), 0);
  for (std::size_t b = 0; b < looked_at.size(); ++b)
    if (bodies.bodies[b].is_closed || bodies.bodies[b].is_inner ||
        is_land(mesh.object_kinds[bodies.bodies[b].object.index()]))
      looked_at[b] = -1;
  const SolidFronts fronts(mesh, bodies);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const auto b = bodies.triangle_body[t];
    if (b < 0 || looked_at[static_cast<std::size_t>(b)] < 0) continue;
    double& of = looked_at[static_cast<std::size_t>(b)];
    if (mesh.triangle_sides[t] == Sides::two || mesh.triangle_surface[t] == Surface::ground)
      of = -1;
    else if (mesh.area_m2(t) > 0)
      of += fronts.looked_at_m2(t);
  }
  return looked_at;
}

}  // namespace

TurnedSheets turn_sheets_on_walls(Mesh& mesh, const Bodies& bodies) {
  const std::vector<double> looked_at = looked_at_of(mesh, bodies);
  std::vector<double> of_object(mesh.object_names.size(), 0);
  TurnedSheets turned;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const auto b = bodies.triangle_body[t];
    if (b < 0) continue;
    const auto body = static_cast<std::size_t>(b);
    if (!(looked_at[body] > looked_at_share * bodies.bodies[body].area)) continue;
    std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    ++turned.triangles;
    turned.area_m2 += mesh.area_m2(t);
    of_object[mesh.triangle_object[t].index()] += mesh.area_m2(t);
  }
  if (turned.triangles > 0)
    turned.largest = mesh.object_names[static_cast<std::size_t>(
        std::ranges::max_element(of_object) - of_object.begin())];
  return turned;
}

}  // namespace sunload
