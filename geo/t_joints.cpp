#include "geo/t_joints.h"

#include <algorithm>
#include <cmath>

#include "geo/edge_table.h"

namespace sunload {

namespace {

using Triangle = std::array<std::int32_t, 3>;

double component(Vec3 p, int axis) { return axis == 0 ? p.x : (axis == 1 ? p.y : p.z); }

/// Open edges of one object, and their ends sorted along its longest axis.
class OpenEdges {
 public:
  OpenEdges(const Mesh& mesh, std::vector<EdgeUse> uses) : mesh_(mesh), uses_(std::move(uses)) {
    std::vector<Vec3> points;
    for (const auto& use : uses_) {
      for (const auto v : {use.low, use.high}) {
        ends_.push_back(v);
        points.push_back(at(v));
      }
    }
    const Box box = bounding_box(points);
    const Vec3 size = box.high - box.low;
    axis_ = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    std::sort(ends_.begin(), ends_.end(), [&](std::int32_t a, std::int32_t b) {
      return std::pair(component(at(a), axis_), a) < std::pair(component(at(b), axis_), b);
    });
    ends_.erase(std::unique(ends_.begin(), ends_.end()), ends_.end());
  }

  const std::vector<EdgeUse>& uses() const { return uses_; }

  /// Ends of other edges that lie on this one, ordered from its lower vertex.
  std::vector<std::int32_t> corners_on(const EdgeUse& use, double tolerance) const {
    const Vec3 start = at(use.low), edge = at(use.high) - start;
    const double length = norm(edge);
    std::vector<std::pair<double, std::int32_t>> found;
    const double s0 = component(start, axis_), s1 = component(at(use.high), axis_);
    auto it =
        std::lower_bound(ends_.begin(), ends_.end(), std::min(s0, s1) - tolerance,
                         [&](std::int32_t v, double s) { return component(at(v), axis_) < s; });
    for (; it != ends_.end() && component(at(*it), axis_) <= std::max(s0, s1) + tolerance; ++it) {
      const Vec3 p = at(*it) - start;
      const double along = dot(p, edge) / length;
      if (!(along > tolerance && along < length - tolerance)) continue;
      if (norm(p - edge * (along / length)) <= tolerance) found.emplace_back(along, *it);
    }
    std::sort(found.begin(), found.end());
    std::vector<std::int32_t> result;
    for (const auto& item : found) result.push_back(item.second);
    return result;
  }

 private:
  Vec3 at(std::int32_t v) const { return mesh_.vertices[static_cast<std::size_t>(v)]; }

  const Mesh& mesh_;
  std::vector<EdgeUse> uses_;
  std::vector<std::int32_t> ends_;
  int axis_ = 0;
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

/// Replaces each triangle by its pieces, in place of it.
void replace(Mesh& mesh, std::vector<std::pair<std::uint32_t, std::vector<std::int32_t>>>& found) {
  std::sort(found.begin(), found.end());
  Mesh old = std::move(mesh);
  mesh = {};
  mesh.vertices = std::move(old.vertices);
  mesh.object_names = std::move(old.object_names);
  mesh.object_kinds = std::move(old.object_kinds);
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

std::size_t split_t_joints(Mesh& mesh, double tolerance) {
  std::vector<std::pair<std::uint32_t, std::vector<std::int32_t>>> found;
  std::size_t count = 0;
  for (const auto& object : open_edges(mesh)) {
    for (const auto& use : object.uses()) {
      auto corners = object.corners_on(use, tolerance);
      // The third corner of a sliver lies on its own edge.
      std::erase(corners, mesh.triangles[use.triangle()][(use.corner() + 2) % 3]);
      if (corners.empty()) continue;
      count += corners.size();
      if (!walks_up(mesh, use)) std::reverse(corners.begin(), corners.end());
      found.emplace_back(use.half_edge, std::move(corners));
    }
  }
  if (!found.empty()) replace(mesh, found);
  return count;
}

}  // namespace sunload
