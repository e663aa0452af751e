// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/facing_links.h"

#include <algorithm>
#include <cmath>

#include "geo/mesh/edge_table.h"

namespace sunload {

namespace {

/// Uses of one edge, ordered by the angle of their triangles around it.
std::vector<EdgeUse> around_edge(const Mesh& mesh, std::span<const EdgeUse> uses) {
  const Vec3 start = mesh.vertices[static_cast<std::size_t>(uses[0].low)];
  const Vec3 edge = mesh.vertices[static_cast<std::size_t>(uses[0].high)] - start;
  const double length = norm(edge);
  std::vector<std::pair<double, EdgeUse>> order;
  const auto frame = tangents(length > 0 ? edge / length : Vec3{0, 0, 1});
  for (const auto& use : uses) {
    const Vec3 apex = mesh.corner(use.triangle(), static_cast<int>((use.corner() + 2) % 3)) - start;
    order.emplace_back(std::atan2(dot(apex, frame.bitangent), dot(apex, frame.tangent)), use);
  }
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<EdgeUse> result;
  for (const auto& item : order) result.push_back(item.second);
  return result;
}

}  // namespace

Links link_edges(const Mesh& mesh, const std::vector<std::uint8_t>& included) {
  Links links;
  links.next.assign(3 * mesh.triangle_count(), no_link);
  links.up.assign(3 * mesh.triangle_count(), 0);
  for_each_edge(edge_uses(mesh, included), [&](std::span<const EdgeUse> uses) {
    for (const auto& use : uses) links.up[use.half_edge] = walks_up(mesh, use);
    if (uses.size() == 1) ++links.open_edges;
    if (uses.size() > 2) ++links.nonmanifold_edges;
    if (uses.size() == 2) {
      links.next[uses[0].half_edge] = uses[1].half_edge;
      links.next[uses[1].half_edge] = uses[0].half_edge;
    } else if (uses.size() % 2 == 0) {
      const auto ring = around_edge(mesh, uses);
      for (std::size_t i = 0; i < ring.size(); ++i) {
        links.next[ring[i].half_edge] = ring[(i + 1) % ring.size()].half_edge;
      }
    }
  });
  return links;
}

Grouping group(const Mesh& mesh, const Links& links, const std::vector<std::uint8_t>& included) {
  Grouping g;
  g.body.assign(mesh.triangle_count(), -1);
  g.flip.assign(mesh.triangle_count(), 0);
  std::vector<std::size_t> stack;
  for (std::size_t seed = 0; seed < mesh.triangle_count(); ++seed) {
    if (!included[seed] || g.body[seed] >= 0) continue;
    const auto body = static_cast<std::int32_t>(g.is_linked.size());
    std::uint8_t is_linked = 1, has_conflict = 0;
    g.body[seed] = body;
    stack.push_back(seed);
    while (!stack.empty()) {
      const std::size_t t = stack.back();
      stack.pop_back();
      for (std::size_t h = 3 * t; h < 3 * t + 3; ++h) {
        if (links.next[h] == no_link) {
          is_linked = 0;
          continue;
        }
        const std::size_t neighbour = links.next[h] / 3;
        // The two must walk the edge in opposite directions.
        const auto flip =
            static_cast<std::uint8_t>((links.up[h] ^ g.flip[t]) == links.up[links.next[h]]);
        if (g.body[neighbour] < 0) {
          g.body[neighbour] = body;
          g.flip[neighbour] = flip;
          stack.push_back(neighbour);
        } else if (g.flip[neighbour] != flip) {
          has_conflict = 1;
        }
      }
    }
    g.is_linked.push_back(is_linked);
    g.has_conflict.push_back(has_conflict);
  }
  return g;
}

}  // namespace sunload
