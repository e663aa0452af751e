// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/sight/closed_bodies.h"

#include "geo/base/together.h"

namespace sunload {

namespace {

/// Triangles that hang together by edges.
Together bodies_of(const Occluders& o) {
  Together bodies(o.triangle_count());
  for (std::size_t t = 0; t < o.triangle_count(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      for (const auto other : o.at_edge(t, k)) bodies.join(t, static_cast<std::size_t>(other));
  return bodies;
}

/// How much more often the triangles at an edge pass it as this one does than the other way.
int balance_at(const Occluders& o, std::size_t triangle, std::size_t k) {
  const auto from = o.point(triangle, k), to = o.point(triangle, (k + 1) % 3);
  int balance = 0;
  for (const auto other : o.at_edge(triangle, k))
    for (std::size_t l = 0; l < 3; ++l) {
      const auto t = static_cast<std::size_t>(other);
      const auto a = o.point(t, l), b = o.point(t, (l + 1) % 3);
      balance += (a == from && b == to) - (a == to && b == from);
    }
  return balance;
}

}  // namespace

ClosedBodies closed_bodies(const Occluders& o) {
  const std::size_t count = o.triangle_count();
  Together body = bodies_of(o);
  std::vector<double> volume(count, 0);  // times 6
  std::vector<bool> has_hole(count, false);
  for (std::size_t t = 0; t < count; ++t) {
    const std::size_t b = body.of(t);
    const Vec3 from = o.corner(b, 0);  // near, so that little is lost
    volume[b] += dot(o.corner(t, 0) - from, cross(o.corner(t, 1) - from, o.corner(t, 2) - from));
    if (!o.is_opaque(t)) has_hole[b] = true;
    for (std::size_t k = 0; k < 3; ++k)
      if (o.point(t, k) == o.point(t, (k + 1) % 3) || balance_at(o, t, k) != 0) has_hole[b] = true;
  }
  ClosedBodies bodies{std::vector<Closed>(count, Closed::no), std::vector<std::uint32_t>(count)};
  for (std::size_t t = 0; t < count; ++t) {
    const std::size_t b = body.of(t);
    bodies.body[t] = static_cast<std::uint32_t>(b);
    if (!has_hole[b] && volume[b] != 0)
      bodies.turned[t] = volume[b] > 0 ? Closed::outward : Closed::inward;
  }
  return bodies;
}

}  // namespace sunload
