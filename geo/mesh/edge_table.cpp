// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/edge_table.h"

#include <cmath>
#include <tuple>

#include "geo/base/units.h"
#include "geo/mesh/slope.h"

namespace sunload {

std::vector<EdgeUse> edge_uses(const Mesh& mesh, const std::vector<std::uint8_t>& included) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * mesh.triangle_count());
  const auto by_edge = [](const EdgeUse& a, const EdgeUse& b) {
    return std::tie(a.low, a.high, a.half_edge) < std::tie(b.low, b.high, b.half_edge);
  };
  // Triangles are ordered by object: sorting one object at a time is faster than all at once.
  std::size_t object_begin = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const std::int32_t object = mesh.triangle_object[t].value;
    if (object_begin < uses.size() && uses[object_begin].object != object) {
      std::sort(uses.begin() + static_cast<std::ptrdiff_t>(object_begin), uses.end(), by_edge);
      object_begin = uses.size();
    }
    if (!included[t]) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      uses.push_back(
          {object, std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(3 * t + k)});
    }
  }
  std::sort(uses.begin() + static_cast<std::ptrdiff_t>(object_begin), uses.end(), by_edge);
  return uses;
}

bool is_foot_of_wall(const Mesh& mesh, const EdgeUse& use) {
  const std::size_t t = use.triangle();
  const Vec3 apex = apex_of(mesh, use);
  const double low = mesh.vertices[static_cast<std::size_t>(use.low)].z,
               high = mesh.vertices[static_cast<std::size_t>(use.high)].z;
  return slope_of(mesh, t) == Slope::upright && apex.z > std::max(low, high);
}

bool are_feet_that_touch(const Mesh& mesh, std::span<const EdgeUse> uses) {
  if (uses.size() < 2) return false;
  for (const EdgeUse& use : uses)
    if (!is_foot_of_wall(mesh, use)) return false;
  const std::vector<double> angles = angles_about(mesh, uses);
  return std::ranges::all_of(angles, [&](double angle) {
    return std::abs(std::remainder(angle - angles[0], 2 * pi)) < same_angle;
  });
}

std::vector<double> angles_about(const Mesh& mesh, std::span<const EdgeUse> uses) {
  const Vec3 start = mesh.vertices[static_cast<std::size_t>(uses[0].low)];
  const Vec3 edge = mesh.vertices[static_cast<std::size_t>(uses[0].high)] - start;
  const double length = norm(edge);
  const auto frame = tangents(length > 0 ? edge / length : Vec3{0, 0, 1});
  std::vector<double> angles;
  for (const auto& use : uses) {
    const Vec3 apex = apex_of(mesh, use) - start;
    angles.push_back(std::atan2(dot(apex, frame.bitangent), dot(apex, frame.tangent)));
  }
  return angles;
}

}  // namespace sunload
