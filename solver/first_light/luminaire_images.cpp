// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/first_light/luminaire_images.h"

#include <algorithm>
#include <cmath>

namespace sunload {

LuminaireImages::LuminaireImages(const MirrorGroups& mirrors, const RayCaster& caster)
    : groups_(mirrors),
      caster_(caster),
      plane_of_side_(2 * mirrors.scene().mesh.triangle_count(), -1) {
  for (std::size_t g = 0; g < groups_.size(); ++g) add_planes(g);
}

/// By their distances along the normal, sorted: what is farther from the one before than points are
/// known lies in another plane.
void LuminaireImages::add_planes(std::size_t group) {
  const Vec3 normal = groups_[group].normal;
  std::vector<std::pair<double, std::int32_t>> offsets;
  for (const auto t : groups_[group].triangles)
    offsets.emplace_back(dot(normal, groups_.scene().mesh.corner(static_cast<std::size_t>(t), 0)),
                         t);
  std::sort(offsets.begin(), offsets.end());
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const auto [offset, triangle] = offsets[i];
    if (i == 0 || offset - offsets[i - 1].first > caster_.offset_m())
      planes_.push_back({normal, offset});
    for (const bool front : {true, false})
      if (groups_.of_side(triangle, front) == static_cast<std::int32_t>(group))
        plane_of_side_[side(triangle, front)] = static_cast<std::int32_t>(planes_.size() - 1);
  }
}

double LuminaireImages::on(const Sensor& sensor, std::uint64_t& rays) const {
  double E = 0;
  for (std::size_t p = 0; p < planes_.size(); ++p)
    for (const Luminaire& luminaire : groups_.scene().luminaires.all)
      E += in_plane(p, luminaire, sensor, rays);
  return E;
}

double LuminaireImages::in_plane(std::size_t p, const Luminaire& luminaire, const Sensor& sensor,
                                 std::uint64_t& rays) const {
  const auto& [n, offset] = planes_[p];
  const double near = caster_.offset_m();
  const Vec3 from = sensor.position + sensor.normal * near;
  const double of_sensor = dot(n, from) - offset;
  const double of_lamp = dot(n, luminaire.position) - offset;
  if (of_sensor <= near || of_lamp <= near) return 0;
  const Vec3 way = luminaire.position - 2 * of_lamp * n - from;
  const double r = norm(way);
  const Vec3 w = way / r;
  const double cos_theta = dot(sensor.normal, w), cos_mirror = -dot(n, w);
  if (cos_theta <= 0) return 0;
  const Vec3 at = from + way * (of_sensor / (of_sensor + of_lamp));
  const Vec3 before = at + n * near;  // the mirror
  const double I =
      groups_.scene().luminaires.intensity(luminaire, normalized(before - luminaire.position));
  if (I <= 0) return 0;
  const Hit hit = caster_.first_hit(before, w);
  rays += 3;
  if (hit.left_scene() ||
      plane_of_side_[side(hit.triangle, hit.front)] != static_cast<std::int32_t>(p))
    return 0;
  const double rho = groups_.weight_of_hit(hit.triangle, cos_mirror);
  return I * rho * cos_theta / (r * r) * passed(from, before) * passed(before, luminaire.position);
}

/// Share of light that what is between two points lets pass.
double LuminaireImages::passed(Vec3 from, Vec3 to) const {
  const Vec3 way = to - from;
  const double length = norm(way);
  Packet origins{}, ways{};
  put(origins, 0, from);
  // What bears the lamp may lie in its plane, or at its point.
  put(ways, 0, way * std::max(0.0, 1 - caster_.offset_m() / length));
  return static_cast<double>(caster_.passed_up_to(origins, ways, 1).front());
}

}  // namespace sunload
