// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/delaunay.h"

#include <algorithm>

#include "geo/mesh/constrained_delaunay.h"

namespace sunload {

namespace {

using Triangle = std::array<std::int32_t, 3>;

constexpr double area_ratio = 1e-9;  // rounding of sums over some 10^5 corners stays below
/// Triangle × corner pairs asked one by one: a tenth of a second.
constexpr double largest_search = 2e7;
// Rings of n edges may cross n² times; such a polygon means nothing, and would take all memory.
constexpr std::size_t fewest_crossings = 60;  // that are allowed, beside one for each edge

struct TooManyCrossings {};

struct CornerInfo {
  std::int32_t vertex = -1;  // of the mesh
};
struct FaceInfo {
  int depth = -1;  // ring edges between it and the outside
};
using Delaunay = ConstrainedDelaunay<CornerInfo, FaceInfo>;

/// Even-odd rule.
bool is_inside(const std::vector<Point2>& ring, Point2 p) {
  bool inside = false;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const Point2 a = ring[i], b = ring[j];
    if ((a.v > p.v) == (b.v > p.v)) continue;
    if (p.u < a.u + (b.u - a.u) * ((p.v - a.v) / (b.v - a.v))) inside = !inside;
  }
  return inside;
}

/// One polygon at work: mesh vertices in, triangles of mesh vertices out.
class Triangulator {
 public:
  Triangulator(std::vector<Vec3>& vertices, const PlanePolygon& polygon)
      : vertices_(vertices), polygon_(polygon) {}

  struct Result {
    std::vector<Triangle> triangles;
    double area2 = 0;  // doubled, along the polygon's normal
  };

  Result run() {
    insert_rings();
    add_crossings();
    mark_depths();
    Result result = collect([](const auto& face) { return face->info().depth % 2 == 1; });
    if (!has_right_area(result) && search_is_affordable()) {
      const auto seen_rings = rings_on_paper();
      result = collect([&](const auto& face) {
        const Point2 p = middle(face);
        return is_inside(seen_rings[0], p) &&
               std::none_of(seen_rings.begin() + 1, seen_rings.end(),
                            [&](const auto& hole) { return is_inside(hole, p); });
      });
    }
    // The triangulation owns no order that a reader could rely on: give it one.
    std::sort(result.triangles.begin(), result.triangles.end());
    return result;
  }

  bool has_right_area(const Result& result) const {
    return std::abs(result.area2 - polygon_.area2) <= area_ratio * std::abs(polygon_.area2);
  }

 private:
  using Face = Delaunay::Face_handle;
  using Edge = std::array<std::int32_t, 2>;

  void insert_rings() {
    std::vector<Edge> edges;
    Face near{};
    for (const auto& ring : polygon_.rings) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const auto a = ring[i], b = ring[(i + 1) % ring.size()];
        edges.push_back({std::min(a, b), std::max(a, b)});
        const Point2 p = polygon_.plane.seen(vertices_[static_cast<std::size_t>(a)]);
        const auto handle = delaunay_.insert({p.u, p.v}, near);
        if (handle->info().vertex < 0) handle->info().vertex = a;
        handles_.emplace_back(a, handle);
        near = handle->face();
      }
    }
    std::sort(handles_.begin(), handles_.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    insert_odd_edges(edges);
  }

  // An edge that is walked an even number of times separates nothing.
  void insert_odd_edges(std::vector<Edge>& edges) {
    std::sort(edges.begin(), edges.end());
    const std::size_t most_vertices =
        delaunay_.number_of_vertices() + fewest_crossings + edges.size();
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
      while (end < edges.size() && edges[end] == edges[begin]) ++end;
      if ((end - begin) % 2 == 0) continue;
      const auto a = handle_of(edges[begin][0]), b = handle_of(edges[begin][1]);
      if (a != b) delaunay_.insert_constraint(a, b);
      if (delaunay_.number_of_vertices() > most_vertices) throw TooManyCrossings{};
    }
  }

  Delaunay::Vertex_handle handle_of(std::int32_t vertex) const {
    return std::lower_bound(handles_.begin(), handles_.end(), vertex,
                            [](const auto& item, std::int32_t v) { return item.first < v; })
        ->second;
  }

  // Corners that CGAL made where edges cross.
  std::size_t add_crossings() {
    std::size_t count = 0;
    for (const auto handle : delaunay_.finite_vertex_handles()) {
      if (handle->info().vertex >= 0) continue;
      handle->info().vertex = static_cast<std::int32_t>(vertices_.size());
      vertices_.push_back(polygon_.plane.lifted({handle->point().x(), handle->point().y()}));
      ++count;
    }
    return count;
  }

  void mark_depths() {
    std::vector<Face> layer{delaunay_.infinite_face()};
    for (int depth = 0; !layer.empty(); ++depth) {
      std::vector<Face> next_layer;
      while (!layer.empty()) {
        const Face face = layer.back();
        layer.pop_back();
        if (face->info().depth >= 0) continue;
        face->info().depth = depth;
        for (int k = 0; k < 3; ++k) {
          const Face neighbour = face->neighbor(k);
          if (neighbour->info().depth >= 0) continue;
          (face->is_constrained(k) ? next_layer : layer).push_back(neighbour);
        }
      }
      layer.swap(next_layer);
    }
  }

  template <class IsWanted>
  Result collect(IsWanted is_wanted) const {
    Result result;
    for (const auto face : delaunay_.finite_face_handles()) {
      if (!is_wanted(face)) continue;
      Triangle t{};
      for (int k = 0; k < 3; ++k) t[static_cast<std::size_t>(k)] = face->vertex(k)->info().vertex;
      if (polygon_.plane.is_mirrored()) std::swap(t[1], t[2]);
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      result.triangles.push_back(t);
      result.area2 += dot(newell(vertices_, {t[0], t[1], t[2]}), polygon_.plane.normal());
    }
    return result;
  }

  bool search_is_affordable() const {
    return static_cast<double>(delaunay_.number_of_faces()) *
               static_cast<double>(handles_.size()) <=
           largest_search;
  }

  std::vector<std::vector<Point2>> rings_on_paper() const {
    std::vector<std::vector<Point2>> result;
    for (const auto& ring : polygon_.rings) {
      auto& points = result.emplace_back();
      for (const auto v : ring) {
        points.push_back(polygon_.plane.seen(vertices_[static_cast<std::size_t>(v)]));
      }
    }
    return result;
  }

  Point2 middle(Face face) const {
    Point2 sum{0, 0};
    for (int k = 0; k < 3; ++k) {
      sum.u += face->vertex(k)->point().x() / 3;
      sum.v += face->vertex(k)->point().y() / 3;
    }
    return sum;
  }

  std::vector<Vec3>& vertices_;
  const PlanePolygon& polygon_;
  Delaunay delaunay_;
  std::vector<std::pair<std::int32_t, Delaunay::Vertex_handle>> handles_;
};

}  // namespace

Vec3 newell(const std::vector<Vec3>& vertices, const Ring& ring) {
  const Vec3 origin = vertices[static_cast<std::size_t>(ring[0])];
  Vec3 sum;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    sum += cross(vertices[static_cast<std::size_t>(ring[i])] - origin,
                 vertices[static_cast<std::size_t>(ring[i + 1])] - origin);
  }
  return sum;
}

PolygonTriangles delaunay_triangles(std::vector<Vec3>& vertices, const PlanePolygon& polygon) {
  using Outcome = PolygonTriangles::Outcome;
  const std::size_t vertices_before = vertices.size();
  try {
    Triangulator triangulator(vertices, polygon);
    auto result = triangulator.run();
    const bool is_exact = vertices.size() == vertices_before && triangulator.has_right_area(result);
    return {std::move(result.triangles), is_exact ? Outcome::exact : Outcome::crossing};
  } catch (const CGAL::Failure_exception&) {
  } catch (const TooManyCrossings&) {
  }
  vertices.resize(vertices_before);
  return {{}, Outcome::failed};
}

}  // namespace sunload
