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

struct Climb {
  const std::int32_t* parent;  ///< of each element
  const Hierarchy::Sphere* sphere;
  std::int32_t patches;  ///< elements without spheres
};

/// One step up of each point's element whose parent is small enough; false where all have ended.
SUNLOAD_VECTOR_CODE bool climb_together(const Climb climb, const LinkedPoints& points,
                                        std::int32_t (&element)[packet_size],
                                        std::int32_t (&next)[packet_size]) {
  std::int32_t steps = 0;
  for (std::size_t l = 0; l < packet_size; ++l) {
    const std::int32_t up = next[l];
    const Hierarchy::Sphere& sphere = climb.sphere[up < 0 ? 0 : up - climb.patches];
    const double x = static_cast<double>(sphere.x) - points.x[l],
                 y = static_cast<double>(sphere.y) - points.y[l],
                 z = static_cast<double>(sphere.z) - points.z[l];
    const double distance_m = points.path_m[l] - norm({x, y, z});
    const bool goes_up = up >= 0 && largest_form_factor(static_cast<double>(sphere.radius),
                                                        distance_m) <= points.largest_link[l];
    element[l] = goes_up ? up : element[l];
    next[l] = goes_up ? climb.parent[goes_up ? up : 0] : -1;
    steps += goes_up ? 1 : 0;
  }
  return steps > 0;
}

}  // namespace

void linked_elements(const Hierarchy& hierarchy, const LinkedPoints& points,
                     std::uint32_t (&element)[packet_size]) {
  std::int32_t at[packet_size], next[packet_size];
  for (std::size_t l = 0; l < packet_size; ++l) {
    at[l] = std::max(points.patch[l], 0);
    next[l] = points.patch[l] < 0 ? -1 : hierarchy.parent(static_cast<std::size_t>(at[l]));
  }
  if (hierarchy.element_count() > hierarchy.patch_count()) {
    const Climb climb{hierarchy.parents().data(), &hierarchy.sphere(0),
                      static_cast<std::int32_t>(hierarchy.patch_count())};
    while (climb_together(climb, points, at, next)) continue;
  }
  for (std::size_t l = 0; l < packet_size; ++l) element[l] = static_cast<std::uint32_t>(at[l]);
}

}  // namespace sunload
