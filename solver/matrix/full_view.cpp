// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/matrix/full_view.h"

#include <algorithm>
#include <cmath>

namespace sunload {

namespace {

Vec3 least(Vec3 a, Vec3 b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3 most(Vec3 a, Vec3 b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

/// dot(n, x) ≤ d inside.
struct HalfSpace {
  Vec3 n;
  double d = 0;
};

/// Convex hull of two polygons by planes on which it lies, as far as they are found.
struct Shaft {
  std::vector<Vec3> corners;
  std::vector<HalfSpace> sides;
  Vec3 low, high;
};

/// Adds the plane with this normal through `at`, where all corners lie on one side of it.
void add_side(Vec3 normal, Vec3 at, double touch_m, Shaft& shaft) {
  const double length = norm(normal);
  if (length <= 0) return;
  const Vec3 n = normal / length;
  const double d = dot(n, at);
  double lowest = 0, highest = 0;
  for (const Vec3& corner : shaft.corners) {
    lowest = std::min(lowest, dot(n, corner) - d);
    highest = std::max(highest, dot(n, corner) - d);
  }
  if (highest <= touch_m) shaft.sides.push_back({n, d});
  if (lowest >= -touch_m) shaft.sides.push_back({-n, -d});
}

/// Planes through an edge of one and a corner of the other.
void add_sides(std::span<const Vec3> edges, std::span<const Vec3> corners, double touch_m,
               Shaft& shaft) {
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const Vec3 along = edges[(k + 1) % edges.size()] - edges[k];
    for (const Vec3& corner : corners)
      add_side(cross(along, corner - edges[k]), edges[k], touch_m, shaft);
  }
}

bool are_apart(Vec3 low, Vec3 high, Vec3 other_low, Vec3 other_high, double touch_m) {
  for (int axis = 0; axis < 3; ++axis)
    if (component(low, axis) >= component(other_high, axis) - touch_m ||
        component(other_low, axis) >= component(high, axis) - touch_m)
      return true;
  return false;
}

}  // namespace

FullView::FullView(const Mesh& mesh) {
  double largest_m = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Vec3 a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
    if (norm(mesh.area_vector2(t)) <= 0) continue;
    triangles_.push_back({least(least(a, b), c), most(most(a, b), c), {a, b, c}, mesh.normal(t)});
    for (const Vec3& corner : {a, b, c}) largest_m = std::max(largest_m, norm(corner));
  }
  constexpr double rounding = 1e-9;  // of coordinates in double, and of edges halved some times
  touch_m_ = rounding * largest_m;
}

bool FullView::is_proved(std::span<const Vec3> from, Vec3 from_normal, std::span<const Vec3> to,
                         Vec3 to_normal) const {
  Shaft shaft;
  shaft.corners.assign(from.begin(), from.end());
  shaft.corners.insert(shaft.corners.end(), to.begin(), to.end());
  shaft.low = shaft.high = shaft.corners.front();
  for (const Vec3& corner : shaft.corners) {
    shaft.low = least(shaft.low, corner);
    shaft.high = most(shaft.high, corner);
  }
  shaft.sides = {{-from_normal, dot(-from_normal, from.front())},
                 {-to_normal, dot(-to_normal, to.front())}};
  add_sides(from, to, touch_m_, shaft);
  add_sides(to, from, touch_m_, shaft);
  return std::none_of(triangles_.begin(), triangles_.end(), [&](const Triangle& t) {
    if (are_apart(t.low, t.high, shaft.low, shaft.high, touch_m_)) {
      // Boxes without depth are apart from all that they lie in: the planes below tell.
      const Vec3 depth = shaft.high - shaft.low;
      if (std::min({depth.x, depth.y, depth.z}) > 2 * touch_m_) return false;
    }
    for (const HalfSpace& side : shaft.sides)
      if (std::all_of(std::begin(t.corner), std::end(t.corner),
                      [&](Vec3 corner) { return dot(side.n, corner) >= side.d - touch_m_; }))
        return false;
    double lowest = 0, highest = 0;
    for (const Vec3& corner : shaft.corners) {
      const double height = dot(corner - t.corner[0], t.normal);
      lowest = std::min(lowest, height);
      highest = std::max(highest, height);
    }
    return lowest < -touch_m_ && highest > touch_m_;
  });
}

}  // namespace sunload
