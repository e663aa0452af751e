// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Small convex polygons in the plane across a sun's light, counter-clockwise.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace sunload {

/// A place in that plane [m].
struct ViewCorner {
  double x, y;
};

/// Up to `most` corners, held in place; `add` does not check for room.
class ViewPolygon {
 public:
  static constexpr std::size_t most = 16;
  ViewPolygon() {}  // NOLINT(modernize-use-equals-default): corners come by `add`
  ViewPolygon(const ViewPolygon& other) : size_(other.size_) { take_corners_of(other); }
  ViewPolygon& operator=(const ViewPolygon& other) {
    size_ = other.size_;
    take_corners_of(other);
    return *this;
  }

  std::size_t size() const { return size_; }
  bool has_area() const { return size_ > 2; }
  const ViewCorner& operator[](std::size_t i) const { return corner_[i]; }
  void clear() { size_ = 0; }
  void add(ViewCorner corner) { corner_[size_++] = corner; }
  void drop_last() { --size_; }
  ViewPolygon reversed() const {
    ViewPolygon other;
    for (std::size_t k = size_; k > 0; --k) other.add(corner_[k - 1]);
    return other;
  }
  double area() const {  ///< 0 of fewer than three corners
    if (!has_area()) return 0;
    double twice = 0;
    const ViewCorner o = corner_[0];
    for (std::size_t k = 2; k < size_; ++k) {
      const ViewCorner a = corner_[k - 1], b = corner_[k];
      twice += (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
    }
    return twice / 2;
  }

 private:
  void take_corners_of(const ViewPolygon& other) {
    std::copy_n(other.corner_.data(), size_, corner_.data());
  }

  std::size_t size_ = 0;
  std::array<ViewCorner, most> corner_;
};

/// The line through an edge, whose normal (x, y) points outward and is as long as the edge.
struct ViewLine {
  double x, y, offset;
  double beyond(const ViewCorner& p) const { return p.x * x + p.y * y - offset; }
};
inline ViewLine line_through(const ViewCorner& p, const ViewCorner& q) {
  const double x = q.y - p.y, y = p.x - q.x;
  return {x, y, p.x * x + p.y * y};
}

/// Smallest box about the corners that were included; empty at first.
struct ViewBox {
  double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300;
  void include(const ViewCorner& p) {
    x0 = std::min(x0, p.x);
    x1 = std::max(x1, p.x);
    y0 = std::min(y0, p.y);
    y1 = std::max(y1, p.y);
  }
  void include_box(const ViewBox& b) {
    include(ViewCorner{b.x0, b.y0});
    include(ViewCorner{b.x1, b.y1});
  }
  bool is_apart_from(const ViewBox& b, double by_x, double by_y) const {
    return b.x0 > x1 + by_x || b.x1 < x0 - by_x || b.y0 > y1 + by_y || b.y1 < y0 - by_y;
  }
};

}  // namespace sunload
