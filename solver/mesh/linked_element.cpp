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

struct Spheres {
  alignas(64) double x[packet_size], y[packet_size], z[packet_size], radius[packet_size];
};

/// Bounds of form factors of what lies in the spheres, as `linked_element` has them.
SUNLOAD_VECTOR_CODE void bound_form_factors(const Spheres& __restrict spheres,
                                            const LinkedPoints& __restrict points,
                                            double* __restrict bound) {
  for (std::size_t l = 0; l < packet_size; ++l) {
    const Vec3 away{spheres.x[l] - points.x[l], spheres.y[l] - points.y[l],
                    spheres.z[l] - points.z[l]};
    bound[l] = largest_form_factor(spheres.radius[l], points.path_m[l] - norm(away));
  }
}

/// One step up of each point's element whose parent is small enough; false where all have ended.
bool climb_together(const Hierarchy& hierarchy, const LinkedPoints& points,
                    std::int32_t (&element)[packet_size], std::int32_t (&next)[packet_size]) {
  const auto patches = static_cast<std::int32_t>(hierarchy.patch_count());
  Spheres spheres;
  for (std::size_t l = 0; l < packet_size; ++l) {
    const auto& [x, y, z, radius] =
        hierarchy.sphere(static_cast<std::size_t>(std::max(next[l] - patches, 0)));
    spheres.x[l] = static_cast<double>(x);
    spheres.y[l] = static_cast<double>(y);
    spheres.z[l] = static_cast<double>(z);
    spheres.radius[l] = static_cast<double>(radius);
  }
  alignas(64) double bound[packet_size];
  bound_form_factors(spheres, points, bound);
  bool any = false;
  for (std::size_t l = 0; l < packet_size; ++l) {
    if (next[l] < 0) continue;
    if (bound[l] > points.largest_link[l]) {
      next[l] = -1;
      continue;
    }
    element[l] = next[l];
    next[l] = hierarchy.parent(static_cast<std::size_t>(next[l]));
    any = true;
  }
  return any;
}

}  // namespace

void linked_elements(const Hierarchy& hierarchy, const LinkedPoints& points,
                     std::uint32_t (&element)[packet_size]) {
  std::int32_t at[packet_size], next[packet_size];
  for (std::size_t l = 0; l < packet_size; ++l) {
    at[l] = std::max(points.patch[l], 0);
    next[l] = points.patch[l] < 0 ? -1 : hierarchy.parent(static_cast<std::size_t>(at[l]));
  }
  if (hierarchy.element_count() > hierarchy.patch_count())
    while (climb_together(hierarchy, points, at, next)) continue;
  for (std::size_t l = 0; l < packet_size; ++l) element[l] = static_cast<std::uint32_t>(at[l]);
}

}  // namespace sunload
