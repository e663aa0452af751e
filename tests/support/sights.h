// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What tests of who sees the sun share.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "tests/support/scenes.h"

namespace sunload::test {

/// Angles in radians, the azimuth from east to north.
inline Vec3 sun_at(double azimuth, double height) {
  return {std::cos(height) * std::cos(azimuth), std::cos(height) * std::sin(azimuth),
          std::sin(height)};
}

inline std::vector<IntervalLight> block_of(const std::vector<Vec3>& directions,
                                           double disk_half_angle = 0) {
  std::vector<IntervalLight> block;
  for (const Vec3& direction : directions) {
    block.push_back(one_second(direction, 1000));
    block.back().number = static_cast<std::uint32_t>(block.size());
    block.back().disk_half_angle = disk_half_angle;
  }
  return block;
}

/// Suns from all sides, some of them low, along axes and diagonals.
inline std::vector<IntervalLight> suns_all_about(std::size_t count, double disk_half_angle = 0) {
  std::vector<Vec3> directions;
  for (std::size_t k = 0; k < count; ++k) {
    const auto i = static_cast<double>(k);
    directions.push_back(sun_at(k % 4 == 3 ? i * pi / 4 : 2.4 * i, 0.02 + 0.09 * i));
  }
  return block_of(directions, disk_half_angle);
}

/// So that nothing is along an axis.
inline Scene turned(Scene scene) {
  const double c = std::cos(0.3), s = std::sin(0.3);
  for (Vec3& p : scene.mesh.vertices) p = {c * p.x - s * p.y + 1.7, s * p.x + c * p.y - 0.9, p.z};
  return scene;
}

}  // namespace sunload::test
