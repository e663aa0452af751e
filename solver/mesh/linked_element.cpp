// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/mesh/linked_element.h"

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

}  // namespace sunload
