// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/mesh/linked_element.h"

#include <algorithm>

#include "geo/base/vector_code.h"
#include "solver/mesh/oracle.h"

namespace sunload {

std::uint32_t linked_element(const Hierarchy& hierarchy, std::size_t patch, Vec3 point,
                             double path_m, double largest_link) {
  std::size_t element = patch;
  for (auto up = hierarchy.parent(element); up >= 0; up = hierarchy.parent(element)) {
    const auto& sphere = hierarchy.sphere(static_cast<std::size_t>(up) - hierarchy.patch_count());
    const Vec3 centre{static_cast<double>(sphere.x), static_cast<double>(sphere.y),
                      static_cast<double>(sphere.z)};
    const double distance_m = path_m - norm(centre - point);
    if (largest_form_factor(static_cast<double>(sphere.radius), distance_m) > largest_link) break;
    element = static_cast<std::size_t>(up);
  }
  return static_cast<std::uint32_t>(element);
}

namespace {

/// Elements of points on their way up, side by side, and those that may be next; -1: none.
struct Climbing {
  alignas(64) std::int32_t element[LinkedPoints::most], next[LinkedPoints::most];
};

/// To the largest elements that are small enough, as `linked_element` has them, until all have
/// ended. In the shape that compilers turn into vector code. `spheres` and `parents`: of inner
/// elements and of all.
SUNLOAD_VECTOR_CODE void climb_all(const float* __restrict spheres,
                                   const std::int32_t* __restrict parents, std::int32_t patches,
                                   const LinkedPoints& __restrict points,
                                   Climbing& __restrict climbing) {
  alignas(64) float x[LinkedPoints::most], y[LinkedPoints::most], z[LinkedPoints::most],
      radius[LinkedPoints::most];
  alignas(64) double bound[LinkedPoints::most];
  alignas(64) std::int32_t up[LinkedPoints::most];
  for (std::int32_t going = 1; going != 0;) {
    for (std::size_t l = 0; l < LinkedPoints::most; ++l) {
      const std::int32_t next = climbing.next[l];
      const auto at = static_cast<std::uint32_t>(next < 0 ? 0 : next - patches) * 4u;
      x[l] = spheres[at];
      y[l] = spheres[at + 1];
      z[l] = spheres[at + 2];
      radius[l] = spheres[at + 3];
      up[l] = parents[static_cast<std::uint32_t>(next < 0 ? 0 : next)];
    }
    for (std::size_t l = 0; l < LinkedPoints::most; ++l) {
      const Vec3 away{static_cast<double>(x[l]) - points.x[l],
                      static_cast<double>(y[l]) - points.y[l],
                      static_cast<double>(z[l]) - points.z[l]};
      bound[l] = largest_form_factor(static_cast<double>(radius[l]), points.path_m[l] - norm(away));
    }
    going = 0;
    for (std::size_t l = 0; l < LinkedPoints::most; ++l) {
      const std::int32_t next = climbing.next[l];
      const bool climbs = next >= 0 && !(bound[l] > points.largest_link[l]);
      climbing.element[l] = climbs ? next : climbing.element[l];
      climbing.next[l] = climbs ? up[l] : -1;
      going |= climbs ? 1 : 0;
    }
  }
}

}  // namespace

void linked_elements(const Hierarchy& hierarchy, const LinkedPoints& points,
                     std::uint32_t (&element)[LinkedPoints::most]) {
  Climbing climbing;
  for (std::size_t l = 0; l < LinkedPoints::most; ++l) {
    climbing.element[l] = std::max(points.patch[l], 0);
    climbing.next[l] =
        points.patch[l] < 0 ? -1 : hierarchy.parent(static_cast<std::size_t>(climbing.element[l]));
  }
  if (hierarchy.element_count() > hierarchy.patch_count())
    climb_all(&hierarchy.sphere(0).x, hierarchy.parents().data(),
              static_cast<std::int32_t>(hierarchy.patch_count()), points, climbing);
  for (std::size_t l = 0; l < LinkedPoints::most; ++l)
    element[l] = static_cast<std::uint32_t>(climbing.element[l]);
}

}  // namespace sunload
