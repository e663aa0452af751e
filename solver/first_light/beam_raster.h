// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Which receivers can lie in the beam that parts of mirrors send along a
/// direction: a conservative raster of these parts seen along it.
#pragma once

#include <span>
#include <vector>

#include "geo/base/vec.h"

namespace sunload {

/// A convex polygon in a plane.
using ConvexPolygon = std::vector<Vec3>;

class BeamRaster {
 public:
  /// Raster of `section` seen from far away along the unit direction `w` (from
  /// receivers to the mirrors). `spread`: tangent of the angle by which light may
  /// leave w, for a sun with a disk. `size`: cells along an edge; coarser ones are smaller and
  /// exclude less.
  BeamRaster(std::span<const ConvexPolygon> section, Vec3 w, double spread, int size = finest);
  /// False only if no point of the hull of these points has one of the polygons
  /// ahead of it.
  bool may_meet(std::span<const Vec3> points) const;

  static constexpr int finest = 256;

 private:
  struct Range {
    int x0, x1, y0, y1;
    double nearest, farthest;  ///< along w
  };
  Range range(std::span<const Vec3> points, double spread) const;

  Vec3 x_axis_, y_axis_, w_;
  double spread_;
  int size_;
  double x0_ = 0, y0_ = 0, cells_per_x_ = 0, cells_per_y_ = 0;
  double farthest_of_all_;
  /// Per cell the largest w·p of its polygons, -inf if none; a cell of the next level is the
  /// largest of 2 × 2 of this one, up to one cell for all.
  struct Level {
    int size;
    std::vector<float> farthest;
    float& at(int x, int y) { return farthest[place_of(x, y)]; }
    float at(int x, int y) const { return farthest[place_of(x, y)]; }
    std::size_t place_of(int x, int y) const {
      return static_cast<std::size_t>(y) * static_cast<std::size_t>(size) +
             static_cast<std::size_t>(x);
    }
  };
  std::vector<Level> levels_;
};

}  // namespace sunload
