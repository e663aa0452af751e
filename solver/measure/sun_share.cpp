// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/measure/sun_share.h"

#include <algorithm>

#include "solver/base/chunks.h"
#include "solver/base/threads.h"

namespace sunload {

std::vector<double> seen_sun_s(std::span<const MeasuredPoint> points, const RayCaster& caster,
                               std::span<const SunStretch> suns) {
  std::vector<double> seen_s(points.size(), 0);
  parallel_for(
      points.size(),
      [&](std::size_t i) {
        const Vec3 origin = points[i].position + points[i].normal * caster.offset_m();
        for (std::size_t first = 0; first < suns.size(); first += packet_size) {
          const std::size_t count = std::min(packet_size, suns.size() - first);
          Packet origins{}, directions{};
          std::uint32_t facing = 0;
          for (std::size_t r = 0; r < count; ++r) {
            put(origins, r, origin);
            put(directions, r, suns[first + r].direction);
            if (dot(points[i].normal, suns[first + r].direction) > 0) facing |= 1u << r;
          }
          if (facing == 0) continue;
          const auto seen = caster.unoccluded_each(origins, directions, facing);
          for (std::size_t r = 0; r < count; ++r)
            if ((seen >> r & 1u) != 0) seen_s[i] += suns[first + r].length_s;
        }
      },
      receivers_per_chunk);
  return seen_s;
}

}  // namespace sunload
