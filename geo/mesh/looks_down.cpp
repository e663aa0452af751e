// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/looks_down.h"

#include <cmath>
#include <vector>

#include "geo/mesh/slope.h"

namespace sunload {

namespace {

/// More of the plan than this looks down: a net share, of which edges of slabs and eaves fall
/// short.
constexpr double downward_majority = 0.5;
/// Less is nobody's ground or roof [m2].
constexpr double least_m2 = 1;

/// Areas of the plan [m2].
struct Plan {
  double up = 0, all = 0;
  bool has_walls = false;
  bool looks_down() const { return all > least_m2 && -up > downward_majority * all; }
  void add(double upward_m2) {
    up += upward_m2;
    all += std::abs(upward_m2);
  }
};

}  // namespace

LooksDown find_looking_down(const Mesh& mesh, const Bodies& bodies, SceneKind kind) {
  std::vector<Plan> of_object(mesh.object_names.size());
  Plan whole;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    if (bodies.triangle_body[t] < 0 || bodies.is_closed(t) || bodies.is_inner(t)) continue;
    if (mesh.triangle_sides[t] == Sides::two || mesh.triangle_surface[t] == Surface::floor)
      continue;
    Plan& plan = of_object[mesh.triangle_object[t].index()];
    if (slope_of(mesh, t) == Slope::upright) {
      plan.has_walls = true;
      continue;
    }
    const double upward_m2 = mesh.area_vector2(t).z / 2;
    plan.add(upward_m2);
    whole.add(upward_m2);
  }
  LooksDown found;
  const bool of_each = kind == SceneKind::city || whole.looks_down();
  double largest_m2 = 0;
  for (std::size_t o = 0; o < of_object.size(); ++o) {
    const Plan& plan = of_object[o];
    if (!plan.looks_down() || !(of_each || plan.has_walls || is_land(mesh.object_kinds[o])))
      continue;
    ++found.objects;
    found.area_m2 += plan.all;
    if (plan.all <= largest_m2) continue;
    largest_m2 = plan.all;
    found.largest = mesh.object_names[o];
  }
  return found;
}

}  // namespace sunload
