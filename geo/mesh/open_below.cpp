// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/open_below.h"

namespace sunload {

OpenBelow::OpenBelow(const Mesh& mesh, const Bodies& bodies)
    : mesh_(mesh), bodies_(bodies), is_house_(bodies.bodies.size(), 1) {
  std::vector<std::uint8_t> is_open(mesh.triangle_count(), 0);
  for (std::size_t t = 0; t < is_open.size(); ++t) {
    is_open[t] = bodies.triangle_body[t] >= 0 && !bodies.is_closed(t) && !bodies.is_inner(t);
  }
  for_each_edge(edge_uses(mesh, is_open), [&](std::span<const EdgeUse> uses) {
    for (const EdgeUse& use : uses)
      if (!is_foot_or_goes_on(use, uses)) is_house_[body(use.triangle())] = 0;
  });
  const std::vector<double> volumes = volumes_above_foot(is_open);
  for (std::size_t b = 0; b < is_house_.size(); ++b)
    if (bodies.bodies[b].is_closed || bodies.bodies[b].is_inner || !(volumes[b] > 0))
      is_house_[b] = 0;
}

/// It is the only one of its body, and a foot, or there are two, one of which walks the edge up and
/// the other down. (Eaves go on beyond the house, and are a body of their own.)
bool OpenBelow::is_foot_or_goes_on(const EdgeUse& use, std::span<const EdgeUse> uses) const {
  const EdgeUse* partner = nullptr;
  for (const EdgeUse& other : uses) {
    if (other.half_edge == use.half_edge || body(other.triangle()) != body(use.triangle()))
      continue;
    if (partner) return false;
    partner = &other;
  }
  return partner ? walks_up(mesh_, use) != walks_up(mesh_, *partner) : is_foot_of_wall(mesh_, use);
}

/// As if each body were closed at its lowest point, times 6.
std::vector<double> OpenBelow::volumes_above_foot(const std::vector<std::uint8_t>& asked) const {
  std::vector<double> volumes(bodies_.bodies.size(), 0);
  for (std::size_t t = 0; t < asked.size(); ++t)
    if (asked[t])
      volumes[body(t)] +=
          dot(mesh_.corner(t, 0) - bodies_.bodies[body(t)].box.low, mesh_.area_vector2(t));
  return volumes;
}

}  // namespace sunload
