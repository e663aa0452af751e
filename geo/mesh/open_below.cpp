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

/// It is the only one of its body, and a foot, or as many walk the edge up as down: two, or four
/// where houses of one body touch. (Eaves go on beyond the house, and are a body of their own.)
bool OpenBelow::is_foot_or_goes_on(const EdgeUse& use, std::span<const EdgeUse> uses) const {
  std::size_t up = 0, down = 0;
  for (const EdgeUse& one : uses)
    if (body(one.triangle()) == body(use.triangle())) ++(walks_up(mesh_, one) ? up : down);
  return up + down == 1 ? is_foot_of_wall(mesh_, use) : up == down;
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
