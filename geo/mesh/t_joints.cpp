// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/t_joints.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "geo/base/check.h"
#include "geo/base/together.h"
#include "geo/mesh/edge_table.h"
#include "geo/mesh/point_tree.h"

namespace sunload {

namespace {

using Triangle = std::array<std::int32_t, 3>;

/// Where no triangles overlap, a corner lies on few edges. Beyond this the pieces of triangles that
/// overlap would need more time and memory than any scene of that size …
constexpr std::size_t corners_at_least = 100'000, corners_per_edge = 8;
/// … and beyond this as much time would pass until it is known that few corners lie on the edges.
constexpr std::size_t looks_at_least = 100'000'000, looks_per_edge = 1000;

/// Open edges of one object, and their ends.
class OpenEdges {
 public:
  OpenEdges(const Mesh& mesh, std::vector<EdgeUse> uses)
      : mesh_(mesh), uses_(std::move(uses)), ends_(mesh.vertices, ends_of(uses_)) {}

  const std::vector<EdgeUse>& uses() const { return uses_; }

  struct Corners {
    std::vector<std::int32_t> on_edge;  ///< ordered from its lower vertex
    std::size_t looks = 0;              ///< what finding them has cost
  };
  /// Ends of other edges that lie on this one.
  Corners corners_on(const EdgeUse& use, double tolerance) const {
    const Vec3 start = at(use.low), edge = at(use.high) - start;
    const double length = norm(edge);
    const auto near = ends_.near_segment(start, at(use.high), tolerance);
    std::vector<std::pair<double, std::int32_t>> found;
    for (const auto v : near.points) {
      const Vec3 p = at(v) - start;
      const double along = dot(p, edge) / length;
      if (!(along > tolerance && along < length - tolerance)) continue;
      if (norm(p - edge * (along / length)) <= tolerance) found.emplace_back(along, v);
    }
    std::sort(found.begin(), found.end());
    Corners result{{}, near.looks};
    for (const auto& item : found) result.on_edge.push_back(item.second);
    return result;
  }

 private:
  static std::vector<std::int32_t> ends_of(const std::vector<EdgeUse>& uses) {
    std::vector<std::int32_t> ends;
    for (const auto& use : uses) ends.insert(ends.end(), {use.low, use.high});
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    return ends;
  }
  Vec3 at(std::int32_t v) const { return mesh_.vertices[static_cast<std::size_t>(v)]; }

  const Mesh& mesh_;
  std::vector<EdgeUse> uses_;
  PointTree ends_;
};

/// A triangle and the corners on its edges, each list from corner k to the next.
struct Split {
  Triangle triangle;
  std::array<std::vector<std::int32_t>, 3> on_edge;
};

/// Halves the piece at the middle of the corners on its fullest edge until no corner is left.
std::vector<Triangle> pieces(Split whole) {
  std::vector<Triangle> result;
  std::vector<Split> stack{std::move(whole)};
  while (!stack.empty()) {
    Split s = std::move(stack.back());
    stack.pop_back();
    std::size_t k = 0;
    for (std::size_t i = 1; i < 3; ++i) {
      if (s.on_edge[i].size() > s.on_edge[k].size()) k = i;
    }
    if (s.on_edge[k].empty()) {
      result.push_back(s.triangle);
      continue;
    }
    const auto& list = s.on_edge[k];
    const auto middle = list.begin() + static_cast<std::ptrdiff_t>(list.size() / 2);
    const auto a = s.triangle[k], b = s.triangle[(k + 1) % 3], c = s.triangle[(k + 2) % 3];
    stack.push_back({{*middle, b, c}, {{{middle + 1, list.end()}, s.on_edge[(k + 1) % 3], {}}}});
    stack.push_back({{a, *middle, c}, {{{list.begin(), middle}, {}, s.on_edge[(k + 2) % 3]}}});
  }
  return result;
}

/// Open edges object by object.
std::vector<OpenEdges> open_edges(const Mesh& mesh) {
  std::vector<OpenEdges> result;
  std::vector<EdgeUse> of_object;
  const auto finish = [&] {
    if (!of_object.empty()) result.emplace_back(mesh, std::move(of_object));
    of_object.clear();
  };
  const std::vector<std::uint8_t> all(mesh.triangle_count(), 1);
  for_each_edge(edge_uses(mesh, all), [&](std::span<const EdgeUse> uses) {
    if (uses.size() % 2 == 0) return;
    if (!of_object.empty() && of_object.back().object != uses[0].object) finish();
    of_object.insert(of_object.end(), uses.begin(), uses.end());
  });
  finish();
  return result;
}

/// A half-edge and the corners on it, in the order in which its triangle walks it.
using EdgeCorners = std::pair<std::uint32_t, std::vector<std::int32_t>>;

/// A piece of an open edge between two corners.
struct Piece {
  std::array<std::int32_t, 3> key;  ///< object, lower and higher vertex
  std::size_t triangle;
  bool is_foot;
};

/// Pieces of all open edges, by their keys.
std::vector<Piece> pieces_of_open_edges(const Mesh& mesh, const std::vector<OpenEdges>& objects,
                                        const std::vector<EdgeCorners>& found) {
  std::vector<Piece> all;
  for (const auto& object : objects)
    for (const EdgeUse& use : object.uses()) {
      const auto at = std::lower_bound(
          found.begin(), found.end(), use.half_edge,
          [](const EdgeCorners& edge, std::uint32_t half_edge) { return edge.first < half_edge; });
      const auto& corners = mesh.triangles[use.triangle()];
      std::int32_t last = corners[use.corner()];
      const bool is_foot = is_foot_of_wall(mesh, use);
      const auto add = [&](std::int32_t next) {
        all.push_back(
            {{use.object, std::min(last, next), std::max(last, next)}, use.triangle(), is_foot});
        last = next;
      };
      if (at != found.end() && at->first == use.half_edge) std::ranges::for_each(at->second, add);
      add(corners[(use.corner() + 1) % 3]);
    }
  std::ranges::stable_sort(all, {}, &Piece::key);
  return all;
}

/// Leaves what is found of triangles that hang together and are then open at feet of walls alone.
/// Returns the number of corners.
std::size_t keep_what_closes(const Mesh& mesh, const std::vector<OpenEdges>& objects,
                             std::vector<EdgeCorners>& found) {
  std::sort(found.begin(), found.end());
  Together together(mesh.triangle_count());
  const std::vector<std::uint8_t> all(mesh.triangle_count(), 1);
  for_each_edge(edge_uses(mesh, all), [&](std::span<const EdgeUse> uses) {
    for (const EdgeUse& use : uses) together.join(uses[0].triangle(), use.triangle());
  });
  std::vector<std::size_t> open;
  const std::vector<Piece> of_edges = pieces_of_open_edges(mesh, objects, found);
  for (std::size_t begin = 0, end = 0; begin < of_edges.size(); begin = end) {
    while (end < of_edges.size() && of_edges[end].key == of_edges[begin].key)
      together.join(of_edges[begin].triangle, of_edges[end++].triangle);
    if (end == begin + 1 && !of_edges[begin].is_foot) open.push_back(of_edges[begin].triangle);
  }
  std::vector<std::uint8_t> is_open(mesh.triangle_count(), 0);
  for (const std::size_t t : open) is_open[together.of(t)] = 1;
  std::erase_if(found,
                [&](const EdgeCorners& edge) { return is_open[together.of(edge.first / 3)] != 0; });
  std::size_t count = 0;
  for (const auto& [half_edge, corners] : found) count += corners.size();
  return count;
}

/// Replaces each triangle by its pieces, in place of it.
void replace(Mesh& mesh, std::vector<EdgeCorners>& found) {
  std::sort(found.begin(), found.end());
  Mesh old = std::move(mesh);
  mesh = {};
  mesh.vertices = std::move(old.vertices);
  mesh.object_names = std::move(old.object_names);
  mesh.object_kinds = std::move(old.object_kinds);
  mesh.families = std::move(old.families);
  mesh.file_materials = std::move(old.file_materials);
  mesh.origin = old.origin;
  auto next = found.begin();
  for (std::size_t t = 0; t < old.triangles.size(); ++t) {
    Split split{old.triangles[t], {}};
    for (; next != found.end() && next->first / 3 == t; ++next) {
      split.on_edge[next->first % 3] = next->second;
    }
    for (const auto& triangle : pieces(std::move(split))) {
      mesh.triangles.push_back(triangle);
      mesh.triangle_object.push_back(old.triangle_object[t]);
      mesh.triangle_material.push_back(old.triangle_material[t]);
      mesh.triangle_facade.push_back(old.triangle_facade[t]);
      mesh.triangle_surface.push_back(old.triangle_surface[t]);
      mesh.triangle_sides.push_back(old.triangle_sides[t]);
    }
  }
}

}  // namespace

std::size_t split_t_joints(Mesh& mesh, double tolerance, const std::string& source, TJoints which) {
  const auto objects = open_edges(mesh);
  std::size_t edges = 0;
  for (const auto& object : objects) edges += object.uses().size();
  const std::size_t most_corners = corners_at_least + corners_per_edge * edges;
  const std::size_t most_looks = looks_at_least + looks_per_edge * edges;

  std::vector<EdgeCorners> found;
  std::size_t count = 0, looks = 0;
  for (const auto& object : objects) {
    for (const auto& use : object.uses()) {
      auto [corners, cost] = object.corners_on(use, tolerance);
      // The third corner of a sliver lies on its own edge.
      std::erase(corners, mesh.triangles[use.triangle()][(use.corner() + 2) % 3]);
      count += corners.size();
      looks += cost;
      if (count > most_corners || looks > most_looks) {
        if (which == TJoints::that_close) return 0;
        throw InputError(
            {source},
            "too many triangles of object '" +
                mesh.object_names[static_cast<std::size_t>(use.object)] +
                "' overlap in a plane or along an edge",
            "their open edges hold, or pass by, so many corners of others that it would take too "
            "long to split them there",
            "remove overlapping faces, or set scene.repair: safe, which splits nothing");
      }
      if (corners.empty()) continue;
      if (!walks_up(mesh, use)) std::reverse(corners.begin(), corners.end());
      found.emplace_back(use.half_edge, std::move(corners));
    }
  }
  if (which == TJoints::that_close && !found.empty())
    count = keep_what_closes(mesh, objects, found);
  if (!found.empty()) replace(mesh, found);
  return count;
}

}  // namespace sunload
