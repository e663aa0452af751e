// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/measure/sky_component.h"

#include <algorithm>
#include <cmath>

#include "geo/base/units.h"
#include "solver/base/chunks.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

/// A direction and its part of the sky's light: L dω / ∫ L sin(elevation) dω.
struct SkyRay {
  Vec3 direction;
  double weight = 0;
};

/// A spiral of equal solid angles, each turned by the golden angle (Swinbank & Purser 2006,
/// Fibonacci grids, Q. J. R. Meteorol. Soc. 132): no rows of them lie along the walls of a court.
std::vector<SkyRay> sky_rays(const std::function<bool(Vec3)>& is_open) {
  const double golden_angle = pi * (3 - std::sqrt(5.0));
  std::vector<SkyRay> rays;
  double level = 0;
  for (std::uint32_t i = 0; i < sky_directions; ++i) {
    const double u = (i + 0.5) / sky_directions, azimuth = i * golden_angle;
    const double level_part = std::sqrt(1 - u * u);
    const Vec3 w{level_part * std::sin(azimuth), level_part * std::cos(azimuth), u};
    const double radiance = 1 + 2 * u;
    level += radiance * u;
    if (is_open(w)) rays.push_back({w, radiance});
  }
  for (SkyRay& ray : rays) ray.weight /= level;
  return rays;
}

double seen_light(const MeasuredPoint& point, const RayCaster& caster,
                  std::span<const SkyRay> rays) {
  const Vec3 origin = point.position + point.normal * caster.offset_m();
  double sum = 0;
  Packet origins{}, directions{};
  double light[packet_size] = {};
  std::size_t count = 0;
  const auto cast = [&] {
    if (count == 0) return;
    const auto all = count == packet_size ? (1u << packet_size) - 1 : (1u << count) - 1;
    const auto seen = caster.unoccluded_each(origins, directions, all);
    for (std::size_t r = 0; r < count; ++r)
      if ((seen >> r & 1u) != 0) sum += light[r];
    count = 0;
  };
  for (const SkyRay& ray : rays) {
    const double cos_theta = dot(point.normal, ray.direction);
    if (cos_theta <= 0) continue;
    put(origins, count, origin);
    put(directions, count, ray.direction);
    light[count++] = ray.weight * cos_theta;
    if (count == packet_size) cast();
  }
  cast();
  return sum;
}

}  // namespace

std::vector<double> overcast_sky_components(std::span<const MeasuredPoint> points,
                                            const RayCaster& caster,
                                            const std::function<bool(Vec3)>& is_open) {
  const auto rays = sky_rays(is_open);
  std::vector<double> shares(points.size());
  parallel_for(
      points.size(), [&](std::size_t i) { shares[i] = seen_light(points[i], caster, rays); },
      receivers_per_chunk);
  return shares;
}

}  // namespace sunload
