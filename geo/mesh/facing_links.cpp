// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/facing_links.h"

#include <algorithm>

#include "geo/base/units.h"
#include "geo/mesh/edge_table.h"

namespace sunload {

namespace {

/// A use of an edge and where its triangle lies about it.
struct AngledUse {
  double angle = 0;
  std::uint32_t half_edge = 0;
  std::int32_t sheet = -1;  ///< what hangs together by edges of two uses
  bool up = false;          ///< with the fronts that these edges give it: it looks to larger angles
};

std::vector<AngledUse> by_angle(const Mesh& mesh, const Links& links, const Grouping& sheets,
                                std::span<const EdgeUse> uses) {
  const std::vector<double> angles = angles_about(mesh, uses);
  std::vector<AngledUse> order;
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const std::size_t t = uses[i].triangle();
    order.push_back({angles[i], uses[i].half_edge, sheets.body[t],
                     (links.up[uses[i].half_edge] ^ sheets.flip[t]) != 0});
  }
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.angle < b.angle; });
  return order;
}

/// How well `use` goes on after the one before it: of one sheet, the two must walk the edge in
/// opposite directions; the fronts of different sheets may be wrong.
int fit(const AngledUse& before, const AngledUse& use) {
  const bool is_opposite = before.up != use.up;
  return before.sheet == use.sheet ? (is_opposite ? 3 : 0) : (is_opposite ? 2 : 1);
}

/// Uses of one edge by the angle of their triangles around it. Of those that lie on each other
/// that one comes first that goes on from what is before them, so that solids which touch stay
/// apart; their fronts look at each other where nothing says which is first.
std::vector<AngledUse> around_edge(std::vector<AngledUse> order) {
  const std::size_t count = order.size();
  const auto begins = [&](std::size_t i) {
    const double before = i > 0 ? order[i - 1].angle : order[count - 1].angle - 2 * pi;
    return order[i].angle - before > same_angle;
  };
  // From one that lies alone, or from where some begin that do not.
  std::size_t first = 0;
  for (std::size_t i = count; i-- > 0;)
    if (begins(i) && (begins((i + 1) % count) || !begins(first))) first = i;
  std::vector<std::size_t> group(count, 0);
  for (std::size_t i = 1; i < count; ++i)
    group[i] = group[i - 1] + (begins((first + i) % count) ? 1 : 0);
  std::rotate(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(first), order.end());
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t best = i;
    const auto fits = [&](std::size_t k) {
      return i > 0 ? fit(order[i - 1], order[k]) : (order[k].up ? 1 : 0);
    };
    for (std::size_t k = i + 1; k < count && group[k] == group[i]; ++k)
      if (fits(k) > fits(best)) best = k;
    const auto at = order.begin() + static_cast<std::ptrdiff_t>(i);
    std::rotate(at, order.begin() + static_cast<std::ptrdiff_t>(best),
                order.begin() + static_cast<std::ptrdiff_t>(best) + 1);
  }
  return order;
}

/// Links the uses of sheets that have two of them, which go on from each other whatever else meets
/// them at the edge: another solid that touches there, or goes through it. Returns the others.
std::vector<EdgeUse> others_after_linking_sheets(const Grouping& sheets,
                                                 std::span<const EdgeUse> uses, Links& links) {
  std::vector<EdgeUse> others;
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const auto sheet = sheets.body[uses[i].triangle()];
    std::size_t count = 0, partner = i;
    for (std::size_t k = 0; k < uses.size(); ++k) {
      if (sheets.body[uses[k].triangle()] != sheet) continue;
      ++count;
      if (k != i) partner = k;
    }
    const auto walk = [&](std::size_t k) {
      return links.up[uses[k].half_edge] ^ sheets.flip[uses[k].triangle()];
    };
    if (count == 2 && walk(i) != walk(partner))
      links.next[uses[i].half_edge] = uses[partner].half_edge;
    else
      others.push_back(uses[i]);
  }
  return others;
}

}  // namespace

Links link_edges(const Mesh& mesh, const std::vector<std::uint8_t>& included) {
  Links links;
  links.next.assign(3 * mesh.triangle_count(), no_link);
  links.up.assign(3 * mesh.triangle_count(), 0);
  const auto all = edge_uses(mesh, included);
  for_each_edge(all, [&](std::span<const EdgeUse> uses) {
    for (const auto& use : uses) links.up[use.half_edge] = walks_up(mesh, use);
    if (uses.size() == 1 || are_feet_that_touch(mesh, uses)) {
      links.open_edges += uses.size();
      return;
    }
    if (uses.size() > 2) ++links.nonmanifold_edges;
    if (uses.size() != 2) return;
    links.next[uses[0].half_edge] = uses[1].half_edge;
    links.next[uses[1].half_edge] = uses[0].half_edge;
  });
  if (links.nonmanifold_edges == 0) return links;
  const Grouping sheets = group(mesh, links, included);
  for_each_edge(all, [&](std::span<const EdgeUse> uses) {
    if (uses.size() == 2 || uses.size() % 2 != 0 || are_feet_that_touch(mesh, uses)) return;
    const auto others = others_after_linking_sheets(sheets, uses, links);
    if (others.empty()) return;
    const auto ring = around_edge(by_angle(mesh, links, sheets, others));
    for (std::size_t i = 0; i < ring.size(); ++i)
      links.next[ring[i].half_edge] = ring[(i + 1) % ring.size()].half_edge;
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
