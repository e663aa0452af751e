// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/triangulate.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geo/mesh/delaunay.h"

namespace sunload {

namespace {

using Triangle = std::array<std::int32_t, 3>;

constexpr double largest_offset_m = 0.01;      // planarity in val3dity (Ledoux 2018): 1 cm
constexpr double largest_offset_ratio = 1e-3;  // the same for models of centimetres
// Less of an area than this share of one of its corners is what rounding of coordinates leaves of
// lobes that cancel each other out, or so thin that the corner tells its plane better.
constexpr double cancelled = 1e-3;
constexpr double noise = 1e-9;             // of that area: tells no side
constexpr double larger = 1.0001;          // of corners that are alike the first tells the side
constexpr double better_ratio = 1 + 1e-9;  // equal diagonals must not be chosen by rounding

/// Two triangles for a strictly convex quad, none for other shapes.
std::vector<Triangle> cut_quad(const std::vector<Vec3>& vertices, const Ring& quad, Vec3 normal) {
  // Shape of the worse half: doubled area over the square of its longest edge.
  const auto shape = [&](std::size_t a, std::size_t b, std::size_t c) {
    const Vec3 p = vertices[static_cast<std::size_t>(quad[a])],
               q = vertices[static_cast<std::size_t>(quad[b])],
               r = vertices[static_cast<std::size_t>(quad[c])];
    const double longest2 = std::max({dot(q - p, q - p), dot(r - q, r - q), dot(p - r, p - r)});
    return dot(cross(q - p, r - p), normal) / longest2;
  };
  const double first = std::min(shape(0, 1, 2), shape(0, 2, 3));
  const double second = std::min(shape(1, 2, 3), shape(1, 3, 0));
  if (!(first > 0 && second > 0)) return {};
  // Of equal halves (any parallelogram) a quad and its back choose the same.
  const auto lowest = std::min_element(quad.begin(), quad.end()) - quad.begin();
  const bool is_tie = second <= first * better_ratio && first <= second * better_ratio;
  if (is_tie ? lowest % 2 == 1 : second > first) {
    return {{quad[1], quad[2], quad[3]}, {quad[1], quad[3], quad[0]}};
  }
  return {{quad[0], quad[1], quad[2]}, {quad[0], quad[2], quad[3]}};
}

class ModelTriangulator {
 public:
  ModelTriangulator(const PolygonModel& model, const std::vector<std::int32_t>& new_index,
                    Mesh& mesh)
      : model_(model), new_index_(new_index), mesh_(mesh) {}

  void add_polygon(std::size_t p) {
    read_rings(p);
    if (rings_.empty()) {
      ++counts.collapsed;
      return;
    }
    if (rings_.size() > 1) ++counts.with_holes;
    if (rings_.size() == 1 && rings_[0].size() == 3) {
      append(p, {rings_[0][0], rings_[0][1], rings_[0][2]});
      return;
    }
    const Vec3 area_vector2 = newell(mesh_.vertices, rings_[0]), corner = largest_corner();
    const Vec3 upright = plane_normal2(area_vector2, corner);
    if (norm(upright) == 0) {
      ++counts.collapsed;
      return;
    }
    PlanePolygon polygon{rings_, Plane(middle(), normalized(upright)), norm(area_vector2)};
    if (!is_planar(polygon)) ++counts.nonplanar;
    if (rings_.size() == 1 && rings_[0].size() == 4) {
      const auto halves = cut_quad(mesh_.vertices, rings_[0], polygon.plane.normal());
      for (const auto& half : halves) append(p, half);
      if (!halves.empty()) return;
    }
    for (std::size_t r = 1; r < rings_.size(); ++r) {
      polygon.area2 -= std::abs(dot(newell(mesh_.vertices, rings_[r]), polygon.plane.normal()));
    }
    add_general(p, polygon);
  }

  TriangulationCounts counts;

 private:
  void add_general(std::size_t p, const PlanePolygon& polygon) {
    const auto result = delaunay_triangles(mesh_.vertices, polygon);
    if (result.outcome == PolygonTriangles::Outcome::crossing) ++counts.crossing;
    const bool has_failed = result.outcome == PolygonTriangles::Outcome::failed;
    if (has_failed) ++counts.untriangulated;
    if (result.triangles.empty() && !has_failed) ++counts.collapsed;
    for (const auto& triangle : result.triangles) append(p, triangle);
  }

  /// Fills `rings_`; leaves it empty where the outer ring has less than three corners.
  void read_rings(std::size_t p) {
    rings_.clear();
    const auto first = model_.polygon_ring[p], last = model_.polygon_ring[p + 1];
    for (auto r = first; r < last; ++r) {
      Ring ring;
      for (auto i = model_.ring_begin[static_cast<std::size_t>(r)];
           i < model_.ring_begin[static_cast<std::size_t>(r) + 1]; ++i) {
        const auto v =
            new_index_[static_cast<std::size_t>(model_.ring_vertex[static_cast<std::size_t>(i)])];
        if (ring.empty() || ring.back() != v) ring.push_back(v);
      }
      while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
      if (ring.size() >= 3) {
        rings_.push_back(std::move(ring));
      } else if (r == first) {
        return;
      }
    }
  }

  /// Twice the area vector of the largest triangle of three corners in turn: where lobes of a ring
  /// that crosses itself cancel each other, a rectangle with two corners exchanged, it tells the
  /// plane.
  Vec3 largest_corner() const {
    const Ring& ring = rings_[0];
    const auto at = [&](std::size_t k) {
      return mesh_.vertices[static_cast<std::size_t>(ring[k % ring.size()])];
    };
    Vec3 largest;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vec3 area2 = cross(at(k + 1) - at(k), at(k + 2) - at(k));
      if (dot(area2, area2) > larger * dot(largest, largest)) largest = area2;
    }
    return largest;
  }

  /// Along the normal of a ring's plane, to the side that its area vector tells.
  static Vec3 plane_normal2(Vec3 area_vector2, Vec3 corner) {
    const double area2 = norm(area_vector2), corner2 = norm(corner);
    if (area2 > cancelled * corner2) return area_vector2;
    const bool tells_side = area2 > noise * corner2;
    return tells_side && dot(area_vector2, corner) < 0 ? -corner : corner;
  }

  Vec3 middle() const {
    Vec3 sum;
    for (const auto v : rings_[0]) sum += mesh_.vertices[static_cast<std::size_t>(v)];
    return sum / static_cast<double>(rings_[0].size());
  }

  bool is_planar(const PlanePolygon& polygon) const {
    double offset = 0, radius2 = 0;
    const Vec3 centre = middle();
    for (const auto& ring : polygon.rings) {
      for (const auto v : ring) {
        const Vec3 p = mesh_.vertices[static_cast<std::size_t>(v)];
        offset = std::max(offset, std::abs(polygon.plane.offset(p)));
        radius2 = std::max(radius2, dot(p - centre, p - centre));
      }
    }
    return offset <= std::min(largest_offset_m, largest_offset_ratio * 2 * std::sqrt(radius2));
  }

  void append(std::size_t p, const Triangle& triangle) {
    const auto& facts = model_.facts[p];
    mesh_.triangles.push_back(triangle);
    mesh_.triangle_object.push_back(facts.object);
    mesh_.triangle_material.push_back(facts.material);
    mesh_.triangle_facade.push_back(FacadeId::none());
    mesh_.triangle_surface.push_back(facts.surface);
    mesh_.triangle_sides.push_back(facts.sides);
  }

  const PolygonModel& model_;
  const std::vector<std::int32_t>& new_index_;
  Mesh& mesh_;
  std::vector<Ring> rings_;
};

/// Polygons in the order of their objects, else as in the file.
std::vector<std::size_t> by_object(const PolygonModel& model) {
  std::vector<std::size_t> begin(model.object_names.size() + 1, 0), order(model.polygon_count());
  for (const auto& facts : model.facts) ++begin[facts.object.index() + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  for (std::size_t p = 0; p < order.size(); ++p) order[begin[model.facts[p].object.index()]++] = p;
  return order;
}

}  // namespace

TriangulationCounts triangulate(const PolygonModel& model,
                                const std::vector<std::int32_t>& new_index, Mesh& mesh) {
  ModelTriangulator triangulator(model, new_index, mesh);
  for (const auto p : by_object(model)) triangulator.add_polygon(p);
  return triangulator.counts;
}

}  // namespace sunload
