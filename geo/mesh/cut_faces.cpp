// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/cut_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <set>
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
CutEdges edges_to_cut(const FaceParts& parts, const std::vector<std::uint8_t>& may_be_cut,
                      const PlaneOfFace& plane_of, double touching_m) {
  CutEdges cut;
  for (std::size_t t = 0; t < parts.mesh.triangle_count(); ++t) {
    const std::size_t face = parts.source[t];
    if (may_be_cut[face] == 0) continue;
    const Crossings found = crossings_of(parts.mesh, t, plane_of(face), touching_m);
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

/// Divides all triangles that have one of these edges.
void divide(FaceParts& parts, const CutEdges& cut, double grid_m) {
  Mesh& mesh = parts.mesh;
  Bodies none;
  none.triangle_body.assign(mesh.triangle_count(), -1);
  DividedMesh divided(mesh, none, grid_m);
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
  std::vector<std::size_t> source = divided.finish().source;
  for (std::size_t& t : source) t = parts.source[t];
  parts.source = std::move(source);
}

/// Of those that may be cut the triangles that some plane cuts, and all that have an edge of these.
std::vector<std::size_t> involved(const Mesh& mesh, std::span<const std::size_t> faces,
                                  std::span<const PlaneOfFace> planes, double touching_m) {
  std::set<Edge> edges;
  for (const std::size_t t : faces)
    if (std::any_of(planes.begin(), planes.end(), [&](const PlaneOfFace& plane_of) {
          return crossings_of(mesh, t, plane_of(t), touching_m).count > 0;
        }))
      for (std::size_t k = 0; k < 3; ++k) edges.insert(edge_of(mesh, t, k));
  std::vector<std::size_t> found;
  for (std::size_t t = 0; t < mesh.triangle_count() && !edges.empty(); ++t)
    if (edges.contains(edge_of(mesh, t, 0)) || edges.contains(edge_of(mesh, t, 1)) ||
        edges.contains(edge_of(mesh, t, 2)))
      found.push_back(t);
  return found;
}

/// Of the mesh these triangles alone; vertices keep their numbers.
Mesh some_of(const Mesh& mesh, const std::vector<std::size_t>& triangles) {
  Mesh some = mesh;
  const auto take = [&](auto& list, const auto& from) {
    list.clear();
    if (from.empty()) return;
    for (const std::size_t t : triangles) list.push_back(from[t]);
  };
  take(some.triangles, mesh.triangles);
  take(some.triangle_object, mesh.triangle_object);
  take(some.triangle_material, mesh.triangle_material);
  take(some.triangle_facade, mesh.triangle_facade);
  take(some.triangle_surface, mesh.triangle_surface);
  take(some.triangle_sides, mesh.triangle_sides);
  take(some.triangle_covered, mesh.triangle_covered);
  return some;
}

/// A part of a triangle whose first `old_vertices` vertices are those of the mesh.
TrianglePart part_in(const Mesh& parts, std::size_t p, std::size_t old_vertices) {
  TrianglePart part;
  part.state = state_of(parts, p);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 at = parts.corner(p, static_cast<int>(k));
    const std::int32_t v = parts.triangles[p][k];
    part.corners[k] = {at.x, at.y, at.z};
    part.old[k] = static_cast<std::size_t>(v) < old_vertices ? v : -1;
  }
  return part;
}

}  // namespace

FaceParts parts_of_faces(const Mesh& mesh, std::span<const std::size_t> faces,
                         std::span<const PlaneOfFace> planes) {
  const double touching_m = contact_of(mesh);
  FaceParts parts;
  parts.source = involved(mesh, faces, planes, touching_m);
  parts.mesh = some_of(mesh, parts.source);
  std::vector<std::uint8_t> may_be_cut(mesh.triangle_count(), 0);
  for (const std::size_t t : faces) may_be_cut[t] = 1;
  for (const PlaneOfFace& plane_of : planes)
    for (;;) {
      const CutEdges cut = edges_to_cut(parts, may_be_cut, plane_of, touching_m);
      if (cut.empty()) break;
      divide(parts, cut, touching_m / roundings_per_contact);
    }
  parts.is_divided.assign(mesh.triangle_count(), 0);
  for (std::size_t p = 1; p < parts.source.size(); ++p)
    if (parts.source[p] == parts.source[p - 1]) parts.is_divided[parts.source[p]] = 1;
  return parts;
}

std::vector<std::size_t> cut_faces(Mesh& mesh, Bodies& bodies, std::span<const std::size_t> faces,
                                   std::span<const PlaneOfFace> planes) {
  const FaceParts parts = parts_of_faces(mesh, faces, planes);
  if (std::find(parts.is_divided.begin(), parts.is_divided.end(), 1) == parts.is_divided.end()) {
    std::vector<std::size_t> same(mesh.triangle_count());
    std::iota(same.begin(), same.end(), std::size_t{0});
    return same;
  }
  DividedMesh divided(mesh, bodies, contact_of(mesh) / roundings_per_contact);
  const std::size_t old_vertices = mesh.vertices.size();
  std::size_t p = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    std::vector<TrianglePart> of_face;
    for (; p < parts.source.size() && parts.source[p] == t; ++p)
      of_face.push_back(part_in(parts.mesh, p, old_vertices));
    if (parts.is_divided[t] != 0)
      divided.divide(t, of_face);
    else
      divided.keep(t, state_of(mesh, t));
  }
  return divided.finish().source;
}

}  // namespace sunload
