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
    const bool is_foot = uses.size() == 1 && is_foot_of_wall(mesh, uses[0]);
    if (is_foot || goes_on(uses)) return;
    for (const EdgeUse& use : uses) is_house_[body(use.triangle())] = 0;
  });
  const std::vector<double> volumes = volumes_above_foot(is_open);
  for (std::size_t b = 0; b < is_house_.size(); ++b)
    if (bodies.bodies[b].is_closed || bodies.bodies[b].is_inner || !(volumes[b] > 0))
      is_house_[b] = 0;
}

/// Two of one body, one of which walks the edge up and the other down.
bool OpenBelow::goes_on(std::span<const EdgeUse> uses) const {
  return uses.size() == 2 && body(uses[0].triangle()) == body(uses[1].triangle()) &&
         walks_up(mesh_, uses[0]) != walks_up(mesh_, uses[1]);
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
