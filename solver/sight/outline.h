// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Small convex polygons in a plane across the sun's direction.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sunload {

/// A corner, with its height above the plane of what may be shaded [m].
struct OutlinePoint {
  double x = 0, y = 0, height = 0;
  int edge = -1;  ///< of the triangle: that from here to the next corner; -1: made by a cut
};

/// Corners in either order, and the lines through its edges, whose normals point outward.
class Outline {
 public:
  static constexpr std::size_t most = 5;  ///< a triangle that is cut twice

  std::size_t size() const { return size_; }
  const OutlinePoint& operator[](std::size_t i) const { return point_[i]; }
  void add(const OutlinePoint& p) { point_[size_++] = p; }

  /// To be called when all corners are there.
  void close() {
    double area2 = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const OutlinePoint &p = point_[i], &q = point_[next(i)];
      area2 +=
          (p.x - point_[0].x) * (q.y - point_[0].y) - (p.y - point_[0].y) * (q.x - point_[0].x);
    }
    const double turn = area2 < 0 ? -1 : 1;
    for (std::size_t i = 0; i < size_; ++i) {
      const OutlinePoint &p = point_[i], &q = point_[next(i)];
      const double x = q.x - p.x, y = q.y - p.y, length = std::sqrt(x * x + y * y);
      // An edge of no length separates nothing.
      const double scale = length > 0 ? turn / length : 0;
      line_[i] = {y * scale, -x * scale, (p.x * y - p.y * x) * scale};
    }
  }

  struct Line {
    double x, y, offset;
    double beyond(const OutlinePoint& p) const { return p.x * x + p.y * y - offset; }
  };
  const Line& line(std::size_t edge) const { return line_[edge]; }
  std::size_t next(std::size_t i) const { return i + 1 < size_ ? i + 1 : 0; }

  /// The part where height >= `least` (or <= it).
  Outline above(double least) const { return cut(least, 1); }
  Outline below(double most_height) const { return cut(most_height, -1); }

  bool contains(double x, double y) const {
    for (std::size_t i = 0; i < size_; ++i)
      if (line_[i].beyond({x, y}) > 0) return false;
    return size_ >= 3;
  }
  /// All of `points` lie farther than `margin` outside of one of its edges.
  bool keeps_off(const Outline& points, double margin) const {
    for (std::size_t i = 0; i < size_; ++i) {
      double nearest = line_[i].beyond(points[0]);
      for (std::size_t k = 1; k < points.size(); ++k)
        nearest = std::min(nearest, line_[i].beyond(points[k]));
      if (nearest > margin) return true;
    }
    return false;
  }

 private:
  /// Sutherland & Hodgman (1974), Reentrant polygon clipping.
  Outline cut(double height, double sign) const {
    Outline kept;
    for (std::size_t i = 0; i < size_; ++i) {
      const OutlinePoint &p = point_[i], &q = point_[next(i)];
      const double at_p = (p.height - height) * sign, at_q = (q.height - height) * sign;
      if (at_p >= 0) kept.add(p);
      if ((at_p >= 0) == (at_q >= 0)) continue;
      const double t = at_p / (at_p - at_q);
      kept.add({p.x + (q.x - p.x) * t, p.y + (q.y - p.y) * t, height, at_p >= 0 ? -1 : p.edge});
    }
    kept.close();
    return kept;
  }

  OutlinePoint point_[most];
  Line line_[most] = {};
  std::size_t size_ = 0;
};

/// The two are farther apart than `margin`. Where it is false they may be so all the same.
inline bool apart(const Outline& a, const Outline& b, double margin) {
  return a.keeps_off(b, margin) || b.keeps_off(a, margin);
}

/// Edge i of `a` is farther than `margin` from `b`, which may lie inside of `a`. Likewise.
inline bool edge_apart(const Outline& a, std::size_t i, const Outline& b, double margin) {
  double least = a.line(i).beyond(b[0]), most = least;
  for (std::size_t k = 1; k < b.size(); ++k) {
    const double beyond = a.line(i).beyond(b[k]);
    least = std::min(least, beyond);
    most = std::max(most, beyond);
  }
  if (least > margin || most < -margin) return true;
  const OutlinePoint &p = a[i], &q = a[a.next(i)];
  for (std::size_t k = 0; k < b.size(); ++k)
    if (std::min(b.line(k).beyond(p), b.line(k).beyond(q)) > margin) return true;
  return false;
}

}  // namespace sunload
