// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/ring_crossing.h"

#include <algorithm>

#include "geo/mesh/clip.h"
#include "geo/mesh/constrained_delaunay.h"

namespace sunload {

namespace {

struct Edge2 {
  Point2 a, b;
};

/// Whether the ends of `other` lie on both sides of an edge, none of them on its line.
bool parts_ends(const Edge2& edge, const Edge2& other) {
  const PlanKernel::Point_2 a(edge.a.u, edge.a.v), b(edge.b.u, edge.b.v);
  int left = 0, right = 0;
  for (const Point2& end : {other.a, other.b}) {
    const int side = CGAL::orientation(a, b, PlanKernel::Point_2(end.u, end.v));
    if (side != 0) ++(side > 0 ? left : right);
  }
  return left == 1 && right == 1;
}

bool may_meet(const Edge2& e, const Edge2& f) {
  return std::max(e.a.u, e.b.u) >= std::min(f.a.u, f.b.u) &&
         std::max(f.a.u, f.b.u) >= std::min(e.a.u, e.b.u) &&
         std::max(e.a.v, e.b.v) >= std::min(f.a.v, f.b.v) &&
         std::max(f.a.v, f.b.v) >= std::min(e.a.v, e.b.v);
}

bool cross(const Edge2& e, const Edge2& f) { return parts_ends(e, f) && parts_ends(f, e); }

/// Of two edges that cross.
Point2 crossing(const Edge2& e, const Edge2& f) {
  const auto beyond = [&](Point2 p) {
    return (e.b.u - e.a.u) * (p.v - e.a.v) - (e.b.v - e.a.v) * (p.u - e.a.u);
  };
  const double of_a = beyond(f.a), of_b = beyond(f.b);
  return between(f.a, f.b, of_a == of_b ? 0 : of_a / (of_a - of_b));
}

}  // namespace

std::optional<Point2> ring_crossing(const std::vector<std::vector<Point2>>& rings) {
  std::vector<Edge2> edges;
  for (const auto& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i)
      edges.push_back({ring[i], ring[(i + 1) % ring.size()]});
  const auto west = [](const Edge2& e) { return std::min(e.a.u, e.b.u); };
  std::stable_sort(edges.begin(), edges.end(),
                   [&](const Edge2& e, const Edge2& f) { return west(e) < west(f); });
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t j = i + 1;
         j < edges.size() && west(edges[j]) <= std::max(edges[i].a.u, edges[i].b.u); ++j)
      if (may_meet(edges[i], edges[j]) && cross(edges[i], edges[j]))
        return crossing(edges[i], edges[j]);
  return {};
}

}  // namespace sunload
