// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/inner_faces.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <span>

#include "geo/base/together.h"
#include "geo/mesh/edge_table.h"
#include "geo/mesh/orient.h"

namespace sunload {

namespace {

/// Triangles of objects that hang together where an edge has an odd number of uses above one: of
/// each the height of the lowest point of all of these; of others nothing.
std::vector<std::optional<double>> feet_of_odd_bodies(const Mesh& mesh,
                                                      const std::vector<EdgeUse>& uses) {
  Together together(mesh.triangle_count());
  std::vector<std::size_t> at_odd_edges;
  for_each_edge(uses, [&](std::span<const EdgeUse> at_edge) {
    for (const EdgeUse& use : at_edge) together.join(at_edge[0].triangle(), use.triangle());
    if (at_edge.size() > 1 && at_edge.size() % 2 != 0)
      at_odd_edges.push_back(at_edge[0].triangle());
  });
  std::vector<std::optional<double>> foot(mesh.triangle_count());
  if (at_odd_edges.empty()) return foot;
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (const auto t : at_odd_edges) foot[together.of(t)] = infinite;
  for (std::size_t t = 0; t < foot.size(); ++t)
    if (auto& of = foot[together.of(t)])
      for (int k = 0; k < 3; ++k) of = std::min(*of, mesh.corner(t, k).z);
  for (std::size_t t = 0; t < foot.size(); ++t) foot[t] = foot[together.of(t)];
  return foot;
}

/// Both sides of all triangles, by the part of space that they see.
class BothSides {
 public:
  explicit BothSides(const Mesh& mesh) : mesh_(mesh), parts_(2 * mesh.triangle_count()) {}

  /// About an edge each side sees what the next one sees that looks back at it.
  void join_about(std::span<const EdgeUse> uses) {
    if (uses.size() == 1 && is_foot_of_wall(mesh_, uses[0])) return;
    const std::vector<double> angles = angles_about(mesh_, uses);
    std::vector<std::size_t> order(uses.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return angles[i]; });
    for (std::size_t i = 0; i < order.size(); ++i)
      parts_.join(onward(uses[order[i]]), backward(uses[order[(i + 1) % order.size()]]));
  }

  /// Per side, whether its part of space is closed around, or at its foot by what it stands on.
  std::vector<std::uint8_t> are_enclosed(const std::vector<std::optional<double>>& feet) {
    std::vector<double> volume6(2 * mesh_.triangle_count(), 0), area(volume6.size(), 0);
    for (std::size_t side = 0; side < volume6.size(); ++side) {
      const std::size_t t = side / 2;
      if (!feet[t]) continue;
      const Vec3 towards_it = (side % 2 == 0 ? 1.0 : -1.0) * mesh_.area_vector2(t);
      volume6[parts_.of(side)] += dot(mesh_.corner(t, 0) - Vec3{0, 0, *feet[t]}, towards_it);
      area[parts_.of(side)] += norm(towards_it) / 2;
    }
    std::vector<std::uint8_t> flags(volume6.size(), 0);
    for (std::size_t side = 0; side < flags.size(); ++side) {
      const std::size_t part = parts_.of(side);
      flags[side] = feet[side / 2] && encloses(-volume6[part] / 6, area[part]);
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
  const auto feet = feet_of_odd_bodies(mesh, uses);
  if (std::ranges::none_of(feet, [](const auto& foot) { return foot.has_value(); })) return flags;
  BothSides sides(mesh);
  for_each_edge(uses, [&](std::span<const EdgeUse> at_edge) {
    if (feet[at_edge[0].triangle()]) sides.join_about(at_edge);
  });
  const std::vector<std::uint8_t> enclosed = sides.are_enclosed(feet);
  for (std::size_t t = 0; t < flags.size(); ++t) flags[t] = enclosed[2 * t] && enclosed[2 * t + 1];
  return flags;
}

}  // namespace sunload
