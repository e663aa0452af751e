// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/surface/mirror_groups.h"

#include <algorithm>
#include <cmath>

#include "geo/base/units.h"
#include "solver/base/orientation_index.h"

namespace sunload {

namespace {

// Mirrors whose normals differ by less than this share their image directions:
// a fifth of the sun's radius, well above what rounding of large coordinates
// does to the normals of coplanar panes.
constexpr double same_orientation = 0.05 * radians_per_degree;

}  // namespace

MirrorGroups::MirrorGroups(const Scene& scene)
    : scene_(scene), group_of_side_(2 * scene.mesh.triangle_count(), -1) {
  OrientationIndex orientations(same_orientation);
  for (std::size_t t = 0; t < scene.mesh.triangle_count(); ++t) {
    const MaterialId material = scene.material[t];
    if (!is_mirror(scene.material_of(t))) continue;
    for (std::size_t side = 0; side < (scene.mesh.triangle_sides[t] == Sides::two ? 2 : 1);
         ++side) {
      const Vec3 n = scene.mesh.normal(t, side == 0);
      std::int32_t number = orientations.find(n);
      if (number < 0) {
        number = static_cast<std::int32_t>(groups_.size());
        groups_.push_back({n, {}, {}});
        orientations.add(n, number);
      }
      group_of_side_[2 * t + side] = number;
      MirrorGroup& group = groups_[static_cast<std::size_t>(number)];
      group.triangles.push_back(static_cast<std::int32_t>(t));
      if (std::find(group.materials.begin(), group.materials.end(), material) ==
          group.materials.end())
        group.materials.push_back(material);
    }
  }
}

std::size_t MirrorGroups::reflecting() const {
  std::size_t count = 0;
  for (std::size_t group = 0; group < groups_.size(); ++group)
    if (strongest(group, 1) > 0) ++count;
  return count;
}

double MirrorGroups::reflectance(std::int32_t triangle, double cos_theta) const {
  return mirror_reflectance(scene_.material_of(triangle), cos_theta);
}

double MirrorGroups::weight_of_hit(std::int32_t triangle, double cos_theta) const {
  return mirror_weight_of_hit(scene_.material_of(triangle), cos_theta);
}

double MirrorGroups::strongest(std::size_t group, double cos_theta) const {
  double strongest = 0;
  for (const auto id : groups_[group].materials)
    strongest = std::max(strongest, mirror_reflectance(scene_.materials[id.index()], cos_theta));
  return strongest;
}

}  // namespace sunload
