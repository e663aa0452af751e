// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Luminaires that sensors see in one plane mirror or pane: from the image behind it,
///
///     E = I rho_s(θ_m) cosθ / r²
///
/// with r the whole way, θ_m the angle at the mirror, θ that at the sensor. Where several mirrors
/// follow each other, or surfaces are glossy, patches receive more.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/surface/mirror_groups.h"
#include "solver/surface/ray_caster.h"

namespace sunload {

class LuminaireImages {
 public:
  /// Both must outlive it.
  LuminaireImages(const MirrorGroups& mirrors, const RayCaster& caster);

  /// Irradiance of a sensor by all images [W m-2]; adds the rays cast. Cost: some arithmetic for
  /// each mirror plane and luminaire, three rays where the image is before the sensor.
  double on(const Sensor& sensor, std::uint64_t& rays) const;

 private:
  struct Plane {
    Vec3 normal;
    double offset;  ///< normal · any point of it
  };
  /// Finds the planes of a group's triangles.
  void add_planes(std::size_t group);
  /// Place of a side in `plane_of_side_`.
  static std::size_t side(std::int32_t triangle, bool front) {
    return 2 * static_cast<std::size_t>(triangle) + (front ? 0u : 1u);
  }
  double in_plane(std::size_t plane, const Luminaire& luminaire, const Sensor& sensor,
                  std::uint64_t& rays) const;
  double passed(Vec3 from, Vec3 to) const;

  const MirrorGroups& groups_;
  const RayCaster& caster_;
  std::vector<Plane> planes_;
  std::vector<std::int32_t> plane_of_side_;  ///< [2·triangle + side]; -1: no mirror
};

}  // namespace sunload
