// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/cut_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include "geo/mesh/covered_parts.h"
#include "geo/mesh/covers.h"
#include "geo/mesh/divided_mesh.h"

namespace sunload {

namespace {

using Edge = std::pair<std::int32_t, std::int32_t>;  // the lower vertex first
using CutEdges = std::map<Edge, Vec3>;

Edge edge_of(const Mesh& mesh, std::size_t t, std::size_t k) {
  return std::minmax(mesh.triangles[t][k], mesh.triangles[t][k < 2 ? k + 1 : 0]);
}

Vec3 vertex(const Mesh& mesh, std::int32_t v) { return mesh.vertices[static_cast<std::size_t>(v)]; }

/// Where a plane cuts the edges of a triangle.
struct Crossings {
  std::array<std::pair<Edge, Vec3>, 3> of_edges;
  std::size_t count = 0;
};

/// None where the plane passes by the triangle, or beyond its ends.
Crossings crossings_of(const Mesh& mesh, std::size_t t, const FacePlane& plane, double touching_m) {
  Crossings found;
  double first = infinity, last = -infinity;
  const auto meet = [&](Vec3 at) {
    const double along = dot(plane.along, at);
    first = std::min(first, along);
    last = std::max(last, along);
  };
  const auto beyond = [&](std::int32_t v) {
    return dot(plane.normal, vertex(mesh, v)) - plane.offset;
  };
  for (std::size_t k = 0; k < 3; ++k) {
    const Edge edge = edge_of(mesh, t, k);
    const double a = beyond(edge.first), b = beyond(edge.second);
    if (std::abs(beyond(mesh.triangles[t][k])) <= touching_m)
      meet(mesh.corner(t, static_cast<int>(k)));
    if (std::min(a, b) >= -touching_m || std::max(a, b) <= touching_m) continue;
    const Vec3 from = vertex(mesh, edge.first), to = vertex(mesh, edge.second);
    const Vec3 at = from + (to - from) * (a / (a - b));
    meet(at);
    found.of_edges[found.count++] = {edge, at};
  }
  if (last < plane.from || first > plane.to) found.count = 0;
  return found;
}

/// Edges that planes cut. One that another plane has cut already waits for its parts.
CutEdges edges_to_cut(const Mesh& mesh, const std::vector<std::size_t>& source,
                      const PlaneOfFace& plane_of, double touching_m) {
  CutEdges cut;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const auto plane = plane_of(source[t]);
    if (!plane) continue;
    const Crossings found = crossings_of(mesh, t, *plane, touching_m);
    const auto crossings = std::span(found.of_edges).first(found.count);
    const bool waits = std::any_of(crossings.begin(), crossings.end(), [&](const auto& crossing) {
      const auto known = cut.find(crossing.first);
      return known != cut.end() && norm(known->second - crossing.second) > touching_m;
    });
    if (!waits) cut.insert(crossings.begin(), crossings.end());
  }
  return cut;
}

CoverState state_of(const Mesh& mesh, std::size_t t) {
  return mesh.is_covered(t) ? CoverState::covered : CoverState::open;
}

/// A corner of the mesh, or a new one.
struct Corner {
  std::int32_t old;
  Vec3 at;
};

/// Of a triangle whose edges are cut where there is a value: that from corner k on.
std::vector<TrianglePart> parts_of(const Mesh& mesh, std::size_t t,
                                   const std::array<std::optional<Vec3>, 3>& cuts) {
  const auto count = std::count_if(cuts.begin(), cuts.end(), [](const auto& at) { return !!at; });
  // The edges that are cut come first.
  std::size_t first = 0;
  while (count < 3 && !(cuts[first] && !cuts[(first + 2) % 3])) ++first;
  const auto corner = [&](std::size_t k) {
    const std::int32_t v = mesh.triangles[t][(first + k) % 3];
    return Corner{v, vertex(mesh, v)};
  };
  const auto cut = [&](std::size_t k) { return Corner{-1, *cuts[(first + k) % 3]}; };
  const CoverState state = state_of(mesh, t);
  const auto part_of = [state](const Corner& p, const Corner& q, const Corner& r) {
    const auto place = [](Vec3 at) { return std::array{at.x, at.y, at.z}; };
    return TrianglePart{{place(p.at), place(q.at), place(r.at)}, {p.old, q.old, r.old}, state};
  };
  const Corner a = corner(0), b = corner(1), c = corner(2), ab = cut(0);
  if (count == 1) return {part_of(a, ab, c), part_of(ab, b, c)};
  const Corner bc = cut(1);
  if (count == 3) {
    const Corner ca = cut(2);
    return {part_of(a, ab, ca), part_of(ab, b, bc), part_of(bc, c, ca), part_of(ab, bc, ca)};
  }
  if (norm(bc.at - a.at) <= norm(c.at - ab.at))
    return {part_of(ab, b, bc), part_of(a, ab, bc), part_of(a, bc, c)};
  return {part_of(ab, b, bc), part_of(a, ab, c), part_of(ab, bc, c)};
}

/// Divides all triangles that have one of these edges; returns what each is a part of.
std::vector<std::size_t> divide(Mesh& mesh, Bodies& bodies, const CutEdges& cut, double grid_m) {
  DividedMesh divided(mesh, bodies, grid_m);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    std::array<std::optional<Vec3>, 3> cuts;
    bool any = false;
    for (std::size_t k = 0; k < 3; ++k)
      if (const auto found = cut.find(edge_of(mesh, t, k)); found != cut.end()) {
        cuts[k] = found->second;
        any = true;
      }
    if (any)
      divided.divide(t, parts_of(mesh, t, cuts));
    else
      divided.keep(t, state_of(mesh, t));
  }
  return divided.finish().source;
}

}  // namespace

std::vector<std::size_t> cut_faces(Mesh& mesh, Bodies& bodies, const PlaneOfFace& plane_of) {
  const double touching_m = contact_of(mesh);
  std::vector<std::size_t> source(mesh.triangle_count());
  std::iota(source.begin(), source.end(), std::size_t{0});
  for (;;) {
    const CutEdges cut = edges_to_cut(mesh, source, plane_of, touching_m);
    if (cut.empty()) return source;
    auto parts = divide(mesh, bodies, cut, touching_m / roundings_per_contact);
    for (std::size_t& t : parts) t = source[t];
    source = std::move(parts);
  }
}

}  // namespace sunload
