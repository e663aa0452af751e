// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/apart_faces.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>

#include "geo/base/together.h"
#include "geo/base/units.h"
#include "geo/mesh/edge_table.h"
#include "geo/mesh/orient.h"
#include "geo/mesh/slope.h"

namespace sunload {

namespace {

/// Triangles of an object that hang together where an edge has an odd number of uses above one.
class OddBodies {
 public:
  OddBodies(const Mesh& mesh, const std::vector<EdgeUse>& uses)
      : foot_(mesh.triangle_count()), together_(mesh.triangle_count()) {
    std::vector<std::size_t> at_odd_edges;
    for_each_edge(uses, [&](std::span<const EdgeUse> at_edge) {
      for (const EdgeUse& use : at_edge) together_.join(at_edge[0].triangle(), use.triangle());
      if (at_edge.size() > 1 && at_edge.size() % 2 != 0 && !are_feet_that_touch(mesh, at_edge))
        at_odd_edges.push_back(at_edge[0].triangle());
    });
    is_any_ = !at_odd_edges.empty();
    if (!is_any_) return;
    constexpr double infinite = std::numeric_limits<double>::infinity();
    for (const auto t : at_odd_edges) foot_[together_.of(t)] = infinite;
    for (std::size_t t = 0; t < foot_.size(); ++t)
      if (auto& foot = foot_[together_.of(t)])
        for (int k = 0; k < 3; ++k) foot = std::min(*foot, mesh.corner(t, k).z);
    for (std::size_t t = 0; t < foot_.size(); ++t) foot_[t] = foot_[together_.of(t)];
  }
  bool any() const { return is_any_; }
  /// Height of the lowest point of the body; nothing of a triangle that is of none.
  std::optional<double> foot(std::size_t t) const { return foot_[t]; }
  /// A triangle that stands for the body.
  std::size_t body(std::size_t t) { return together_.of(t); }

 private:
  std::vector<std::optional<double>> foot_;
  Together together_;
  bool is_any_ = false;
};

/// A use of an edge, where its triangle lies about it, and of what sheet it is: triangles that hang
/// together by edges of two uses.
struct AngledUse {
  double angle = 0;
  EdgeUse use;
  std::size_t sheet = 0;
};

/// Of uses that lie on each other, those of a sheet that lies before them come first and those of
/// one that lies behind them last, so that nothing is seen through solids which touch; where that
/// tells nothing, fronts look at each other. `order` is by angle.
void part_those_that_touch(const Mesh& mesh, std::vector<AngledUse>& order) {
  const std::size_t count = order.size();
  const auto begins = [&](std::size_t i) {
    const double before = i > 0 ? order[i - 1].angle : order[count - 1].angle - 2 * pi;
    return order[i].angle - before > same_angle;
  };
  std::size_t first = 0;
  while (first < count && !begins(first)) ++first;
  if (first == count) return;
  std::vector<std::size_t> starts;
  for (std::size_t i = 0; i < count; ++i)
    if (begins((first + i) % count)) starts.push_back(i);
  if (starts.size() == count) return;
  starts.push_back(count);
  std::rotate(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(first), order.end());
  for (std::size_t g = 0; g + 1 < starts.size(); ++g) {
    const std::size_t before = order[(starts[g] + count - 1) % count].sheet,
                      behind = order[starts[g + 1] % count].sheet;
    const auto rank = [&](const AngledUse& one) {
      const int by_sheet = one.sheet == before ? 0 : one.sheet == behind ? 2 : 1;
      return 2 * by_sheet + (walks_up(mesh, one.use) ? 0 : 1);
    };
    std::stable_sort(order.begin() + static_cast<std::ptrdiff_t>(starts[g]),
                     order.begin() + static_cast<std::ptrdiff_t>(starts[g + 1]),
                     [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  }
}

/// Both sides of all triangles, by the part of space that they see.
class BothSides {
 public:
  BothSides(const Mesh& mesh, const std::vector<EdgeUse>& uses)
      : mesh_(mesh), sheets_(mesh.triangle_count()), parts_(2 * mesh.triangle_count()) {
    for_each_edge(uses, [&](std::span<const EdgeUse> at_edge) {
      if (at_edge.size() == 2 && !are_feet_that_touch(mesh, at_edge))
        sheets_.join(at_edge[0].triangle(), at_edge[1].triangle());
    });
  }

  /// About an edge each side sees what the next one sees that looks back at it.
  void join_about(std::span<const EdgeUse> uses) {
    if (uses.size() == 1 && is_foot_of_wall(mesh_, uses[0])) return;
    if (are_feet_that_touch(mesh_, uses)) return;
    const std::vector<double> angles = angles_about(mesh_, uses);
    std::vector<AngledUse> order;
    order.reserve(uses.size());
    for (std::size_t i = 0; i < uses.size(); ++i)
      order.push_back({angles[i], uses[i], sheets_.of(uses[i].triangle())});
    std::ranges::stable_sort(order, {}, &AngledUse::angle);
    if (order.size() > 2) part_those_that_touch(mesh_, order);
    for (std::size_t i = 0; i < order.size(); ++i)
      parts_.join(onward(order[i].use), backward(order[(i + 1) % order.size()].use));
  }

  /// Per side, whether its part of space is closed around, or at its foot by what it stands on.
  std::vector<std::uint8_t> are_enclosed(const OddBodies& bodies) {
    std::vector<double> volume6(2 * mesh_.triangle_count(), 0), area(volume6.size(), 0);
    for (std::size_t side = 0; side < volume6.size(); ++side) {
      const std::size_t t = side / 2;
      const auto foot = bodies.foot(t);
      if (!foot) continue;
      const Vec3 towards_it = (side % 2 == 0 ? 1.0 : -1.0) * mesh_.area_vector2(t);
      volume6[parts_.of(side)] += dot(mesh_.corner(t, 0) - Vec3{0, 0, *foot}, towards_it);
      area[parts_.of(side)] += norm(towards_it) / 2;
    }
    std::vector<std::uint8_t> flags(volume6.size(), 0);
    for (std::size_t side = 0; side < flags.size(); ++side) {
      const std::size_t part = parts_.of(side);
      flags[side] = bodies.foot(side / 2) && encloses(-volume6[part] / 6, area[part]);
    }
    return flags;
  }
  bool see_the_same(std::size_t t) { return parts_.of(2 * t) == parts_.of(2 * t + 1); }

 private:
  // A triangle that walks its edge up has its front where angles about the edge grow.
  std::size_t onward(const EdgeUse& use) const {
    return 2 * use.triangle() + (walks_up(mesh_, use) ? 0 : 1);
  }
  std::size_t backward(const EdgeUse& use) const { return onward(use) ^ 1; }

  const Mesh& mesh_;
  Together sheets_, parts_;
};

}  // namespace

ApartFaces apart_faces(const Mesh& mesh) {
  const std::size_t count = mesh.triangle_count();
  ApartFaces apart{std::vector<std::uint8_t>(count, 0), std::vector<std::uint8_t>(count, 0)};
  const auto uses = edge_uses(mesh, std::vector<std::uint8_t>(count, 1));
  OddBodies bodies(mesh, uses);
  if (!bodies.any()) return apart;
  BothSides sides(mesh, uses);
  for_each_edge(uses, [&](std::span<const EdgeUse> at_edge) {
    if (bodies.foot(at_edge[0].triangle())) sides.join_about(at_edge);
  });
  const std::vector<std::uint8_t> enclosed = sides.are_enclosed(bodies);
  std::vector<std::uint8_t> has_cells(count, 0);  // of what stands for a body
  for (std::size_t t = 0; t < count; ++t) {
    apart.inner[t] = enclosed[2 * t] && enclosed[2 * t + 1];
    if (enclosed[2 * t] != enclosed[2 * t + 1]) has_cells[bodies.body(t)] = 1;
  }
  for (std::size_t t = 0; t < count; ++t)
    apart.loose[t] = has_cells[bodies.body(t)] && !apart.inner[t] && sides.see_the_same(t) &&
                     !is_land(mesh.object_kinds[mesh.triangle_object[t].index()]);
  return apart;
}

}  // namespace sunload
