#include "geo/intersections.h"

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

/// Two triangles of a mesh, each turned so that common corners come first.
class Pair {
 public:
  Pair(const Mesh& mesh, std::size_t t, std::size_t u)
      : mesh_(mesh), a_(mesh.triangles[t]), b_(mesh.triangles[u]) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto same = std::find(b_.begin() + shared_, b_.end(), a_[i]);
      if (same == b_.end()) continue;
      std::swap(a_[i], a_[static_cast<std::size_t>(shared_)]);
      std::swap(*same, b_[static_cast<std::size_t>(shared_)]);
      ++shared_;
    }
  }

  bool meet() const {
    if (shared_ == 3) return false;  // duplicates are counted elsewhere
    if (shared_ == 2) return lie_upon_each_other();
    if (shared_ == 1)
      return CGAL::do_intersect(Kernel::Segment_3(at(a_[1]), at(a_[2])), triangle(b_)) ||
             CGAL::do_intersect(Kernel::Segment_3(at(b_[1]), at(b_[2])), triangle(a_));
    return CGAL::do_intersect(triangle(a_), triangle(b_));
  }

 private:
  /// At a common edge: in one plane and on the same side of it.
  bool lie_upon_each_other() const {
    const Point p = at(a_[0]), q = at(a_[1]), r = at(a_[2]), s = at(b_[2]);
    return CGAL::coplanar(p, q, r, s) &&
           CGAL::coplanar_orientation(p, q, r, s) == CGAL::POSITIVE;
  }

  Point at(std::int32_t vertex) const {
    const Vec3 v = mesh_.vertices[static_cast<std::size_t>(vertex)];
    return {v.x, v.y, v.z};
  }
  Kernel::Triangle_3 triangle(const Corners& c) const { return {at(c[0]), at(c[1]), at(c[2])}; }

  const Mesh& mesh_;
  Corners a_, b_;
  std::ptrdiff_t shared_ = 0;
};

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
        if (!Pair(mesh, t, u).meet()) return;
        is_met[t] = is_met[u] = 1;
        found.between_objects += mesh.triangle_object[t] != mesh.triangle_object[u];
        // Pairs come in no order.
        const std::array<std::size_t, 2> pair{t, u};
        if (found.pairs++ == 0 || pair < found.first) found.first = pair;
      });
  found.triangles = static_cast<std::size_t>(std::count(is_met.begin(), is_met.end(), 1));
  return found;
}

}  // namespace sunload
