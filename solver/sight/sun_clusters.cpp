// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/sun_clusters.h"

#include <algorithm>
#include <cmath>

namespace sunload {

namespace {

/// More than what rounding does to directions.
constexpr double rounding = 1e-12;

SunCluster cluster_of(std::span<const IntervalLight> block, std::size_t first, std::size_t count) {
  const auto suns = block.subspan(first, count);
  Vec3 sum{0, 0, 0};
  for (const auto& sun : suns) sum += sun.direction;
  const Vec3 middle = count == 1 ? suns.front().direction : normalized(sum);
  SunCluster cluster{first, count, {middle, suns.back().direction - suns.front().direction},
                     0,     0,     1};
  for (const auto& sun : suns) {
    const ViewPoint p = cluster.frame(sun.direction);
    const double disk = sun.disk_spread() / (p.h * p.h), more = count > 1 ? rounding : 0;
    cluster.drift_x = std::max(cluster.drift_x, std::abs(count > 1 ? p.x / p.h : 0) + disk + more);
    cluster.drift_y = std::max(cluster.drift_y, std::abs(count > 1 ? p.y / p.h : 0) + disk + more);
    const double lowest = std::asin(sun.direction.z) - sun.disk_half_angle;
    cluster.lowest_sine = std::min(cluster.lowest_sine, std::sin(lowest));
  }
  return cluster;
}

}  // namespace

ViewFrame::ViewFrame(Vec3 sun, Vec3 along) : ViewFrame(sun) {
  const double a = dot(along, x), b = dot(along, y), length = std::hypot(a, b);
  if (length <= 0) return;
  const Vec3 turned = (x * a + y * b) / length;
  y = cross(sun, turned);
  x = turned;
}

std::vector<SunCluster> sun_clusters(std::span<const IntervalLight> block, double widest) {
  std::vector<SunCluster> clusters;
  const double limit = std::tan(widest);
  for (std::size_t k = 0; k < block.size(); ++k) {
    if (!block[k].has_sun()) continue;
    const bool is_next = !clusters.empty() && clusters.back().first + clusters.back().count == k;
    if (is_next && block[k].disk_half_angle <= 0 &&
        block[clusters.back().first].disk_half_angle <= 0) {
      const SunCluster with_it =
          cluster_of(block, clusters.back().first, clusters.back().count + 1);
      if (std::max(with_it.drift_x, with_it.drift_y) <= limit) {
        clusters.back() = with_it;
        continue;
      }
    }
    clusters.push_back(cluster_of(block, k, 1));
  }
  return clusters;
}

}  // namespace sunload
