// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/intersections.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <vector>

namespace sunload {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using TriangleBox = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;
using Corners = std::array<std::int32_t, 3>;

enum class Meeting { none, cutting, covering };

/// Two triangles of a mesh, each turned so that common corners come first.
class Pair {
 public:
  Pair(const Mesh& mesh, std::size_t t, std::size_t u) {
    Corners a = mesh.triangles[t], b = mesh.triangles[u];
    for (std::size_t i = 0; i < 3; ++i) {
      const auto same = std::find(b.begin() + shared_, b.end(), a[i]);
      if (same == b.end()) continue;
      std::swap(a[i], a[static_cast<std::size_t>(shared_)]);
      std::swap(*same, b[static_cast<std::size_t>(shared_)]);
      ++shared_;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      a_[i] = point(mesh, a[i]);
      b_[i] = point(mesh, b[i]);
    }
  }

  Meeting meeting() const {
    if (shared_ == 3) return Meeting::none;  // duplicates are counted elsewhere
    const Sides of_b = sides(a_, b_);
    if (!of_b.above && !of_b.below) return share_area() ? Meeting::covering : Meeting::none;
    // On one side of the other's plane, each can but touch it.
    if (!of_b.above || !of_b.below || shared_ == 2) return Meeting::none;
    const Sides of_a = sides(b_, a_);
    return of_a.above && of_a.below && meet() ? Meeting::cutting : Meeting::none;
  }

 private:
  using Points = std::array<Point, 3>;
  struct Sides {
    bool above = false, below = false;
  };

  static Point point(const Mesh& mesh, std::int32_t vertex) {
    const Vec3 v = mesh.vertices[static_cast<std::size_t>(vertex)];
    return {v.x, v.y, v.z};
  }

  /// On which sides of the plane of `plane` the corners of `of` lie.
  static Sides sides(const Points& plane, const Points& of) {
    Sides result;
    for (const Point& p : of) {
      const auto side = CGAL::orientation(plane[0], plane[1], plane[2], p);
      result.above |= side == CGAL::POSITIVE;
      result.below |= side == CGAL::NEGATIVE;
    }
    return result;
  }

  bool meet() const {
    const Kernel::Triangle_3 a(a_[0], a_[1], a_[2]), b(b_[0], b_[1], b_[2]);
    if (shared_ == 0) return CGAL::do_intersect(a, b);
    return CGAL::do_intersect(Kernel::Segment_3(a_[1], a_[2]), b) ||
           CGAL::do_intersect(Kernel::Segment_3(b_[1], b_[2]), a);
  }

  /// In one plane: no edge of either has the other one beyond it.
  bool share_area() const { return !has_beyond(a_, b_) && !has_beyond(b_, a_); }

  static bool has_beyond(const Points& one, const Points& other) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Point &p = one[k], &q = one[(k + 1) % 3], &r = one[(k + 2) % 3];
      if (std::all_of(other.begin(), other.end(), [&](const Point& s) {
            return CGAL::coplanar_orientation(p, q, r, s) != CGAL::POSITIVE;
          }))
        return true;
    }
    return false;
  }

  Points a_, b_;
  std::ptrdiff_t shared_ = 0;
};

bool is_floor(const Mesh& mesh, std::size_t t) {
  return mesh.triangle_surface[t] == Surface::floor;
}

std::vector<TriangleBox> boxes_of(const Mesh& mesh) {
  std::vector<TriangleBox> boxes;
  boxes.reserve(mesh.triangle_count());
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Vec3 a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
    boxes.emplace_back(CGAL::Bbox_3(std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}),
                                    std::min({a.z, b.z, c.z}), std::max({a.x, b.x, c.x}),
                                    std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})),
                       t);
  }
  return boxes;
}

}  // namespace

Intersections find_intersections(const Mesh& mesh) {
  Intersections found;
  std::vector<std::uint8_t> is_met(mesh.triangle_count(), 0);
  auto boxes = boxes_of(mesh);
  CGAL::box_self_intersection_d(
      boxes.begin(), boxes.end(), [&](const TriangleBox& one, const TriangleBox& other) {
        const auto [t, u] = std::minmax({one.info(), other.info()});  // info() is a temporary
        const Meeting meeting = Pair(mesh, t, u).meeting();
        if (meeting == Meeting::none) return;
        const bool is_covering = meeting == Meeting::covering;
        if (is_covering && (is_floor(mesh, t) || is_floor(mesh, u))) return;
        const bool is_first = found.pairs() == 0;
        ++(is_covering ? found.covering : found.cutting);
        is_met[t] = is_met[u] = 1;
        found.between_objects += mesh.triangle_object[t] != mesh.triangle_object[u];
        // Pairs come in no order.
        const std::array<std::size_t, 2> pair{t, u};
        if (is_first || pair < found.first) found.first = pair;
      });
  found.triangles = static_cast<std::size_t>(std::count(is_met.begin(), is_met.end(), 1));
  return found;
}

}  // namespace sunload
