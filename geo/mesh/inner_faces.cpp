// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/inner_faces.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "geo/base/together.h"
#include "geo/mesh/edge_table.h"

namespace sunload {

namespace {

/// Of area^1.5, as of bodies: less is a sheet folded onto itself.
constexpr double least_volume = 1e-9;

/// Triangles of objects by what they hang together with, and whether that has an edge with an odd
/// number of uses above one.
std::vector<std::uint8_t> of_odd_bodies(const Mesh& mesh, const std::vector<EdgeUse>& uses) {
  Together together(mesh.triangle_count());
  std::vector<std::size_t> at_odd_edges;
  for_each_edge(uses, [&](std::span<const EdgeUse> at_edge) {
    for (const EdgeUse& use : at_edge) together.join(at_edge[0].triangle(), use.triangle());
    if (at_edge.size() > 1 && at_edge.size() % 2 != 0)
      at_odd_edges.push_back(at_edge[0].triangle());
  });
  std::vector<std::uint8_t> is_odd(mesh.triangle_count(), 0), flags(mesh.triangle_count(), 0);
  for (const auto t : at_odd_edges) is_odd[together.of(t)] = 1;
  for (std::size_t t = 0; t < flags.size(); ++t) flags[t] = is_odd[together.of(t)];
  return flags;
}

/// Both sides of all triangles, by the part of space that they see.
class BothSides {
 public:
  explicit BothSides(const Mesh& mesh) : mesh_(mesh), parts_(2 * mesh.triangle_count()) {}

  /// About an edge each side sees what the next one sees that looks back at it.
  void join_about(std::span<const EdgeUse> uses) {
    const std::vector<double> angles = angles_about(mesh_, uses);
    std::vector<std::size_t> order(uses.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return angles[i]; });
    for (std::size_t i = 0; i < order.size(); ++i)
      parts_.join(onward(uses[order[i]]), backward(uses[order[(i + 1) % order.size()]]));
  }

  /// Per side, whether its part of space is closed around.
  std::vector<std::uint8_t> are_enclosed(const std::vector<std::uint8_t>& asked) {
    std::vector<double> volume6(2 * mesh_.triangle_count(), 0), area(volume6.size(), 0);
    for (std::size_t side = 0; side < volume6.size(); ++side) {
      const std::size_t t = side / 2;
      if (!asked[t]) continue;
      const Vec3 towards_it = (side % 2 == 0 ? 1.0 : -1.0) * mesh_.area_vector2(t);
      volume6[parts_.of(side)] += dot(mesh_.corner(t, 0), towards_it);
      area[parts_.of(side)] += norm(towards_it) / 2;
    }
    std::vector<std::uint8_t> flags(volume6.size(), 0);
    for (std::size_t side = 0; side < flags.size(); ++side) {
      const std::size_t part = parts_.of(side);
      flags[side] =
          asked[side / 2] != 0 && -volume6[part] / 6 > least_volume * std::pow(area[part], 1.5);
    }
    return flags;
  }

 private:
  // A triangle that walks its edge up has its front where angles about the edge grow.
  std::size_t onward(const EdgeUse& use) const {
    return 2 * use.triangle() + (walks_up(mesh_, use) ? 0 : 1);
  }
  std::size_t backward(const EdgeUse& use) const { return onward(use) ^ 1; }

  const Mesh& mesh_;
  Together parts_;
};

}  // namespace

std::vector<std::uint8_t> inner_faces(const Mesh& mesh) {
  std::vector<std::uint8_t> flags(mesh.triangle_count(), 0);
  const auto uses = edge_uses(mesh, std::vector<std::uint8_t>(mesh.triangle_count(), 1));
  const std::vector<std::uint8_t> asked = of_odd_bodies(mesh, uses);
  if (std::ranges::count(asked, 1) == 0) return flags;
  BothSides sides(mesh);
  for_each_edge(uses, [&](std::span<const EdgeUse> at_edge) {
    if (asked[at_edge[0].triangle()]) sides.join_about(at_edge);
  });
  const std::vector<std::uint8_t> enclosed = sides.are_enclosed(asked);
  for (std::size_t t = 0; t < flags.size(); ++t) flags[t] = enclosed[2 * t] && enclosed[2 * t + 1];
  return flags;
}

}  // namespace sunload
