// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Which receivers can lie in the beam that parts of mirrors send along a
/// direction: a conservative raster of these parts seen along it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geo/base/vec.h"

namespace sunload {

/// A convex polygon in a plane.
using ConvexPolygon = std::vector<Vec3>;

/// Triangles that lie close together, as columns: what is asked of all of them is found side by
/// side.
struct TriangleColumns {
  static constexpr std::size_t most = 64;  ///< bits of what is told of them
  std::size_t count = 0;
  alignas(64) double x[3][most]{}, y[3][most]{}, z[3][most]{};  ///< of each corner
  void add(const std::array<Vec3, 3>& corners);
};

/// Depths on a square grid across the beam, in a pyramid of coarser grids. Every cell that a
/// polygon may touch is filled: a beam may be reported where there is none, never the reverse.
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
  /// The same of each of these triangles that is `asked`, a bit each. Cost: some nanoseconds for a
  /// triangle that lies beside the raster, a hundred for another.
  std::uint64_t may_meet_each(const TriangleColumns& triangles, std::uint64_t asked) const;

  static constexpr int finest = 256;

 private:
  struct Range {
    int x0, x1, y0, y1;
    double nearest, farthest;  ///< along w
  };
  /// Of what is asked, in cells and along w.
  struct Extent {
    double x0, x1, y0, y1, nearest, farthest;
  };
  Range range(std::span<const Vec3> points, double spread) const;
  Range range(Extent extent, double spread) const;
  void fill(const Range& of_polygon);
  bool may_meet(const Range& range) const;
  /// A cell of the range holds something beyond so many steps.
  bool any_beyond(const Range& range, int nearest) const;
  bool any_beyond_by_levels(const Range& range, int nearest) const;  ///< of many cells

  /// Where points are on the raster, in cells, and how far along w.
  struct Frame {
    Vec3 x_axis, y_axis, w;
    double x0 = 0, y0 = 0, cells_per_x = 0, cells_per_y = 0;
  };
  struct Extents;
  static void find_extents(const TriangleColumns& triangles, const Frame& frame, Extents& out);

  Frame frame_;
  double spread_;
  int size_;
  double farthest_of_all_;
  /// Steps along w from what of all polygons reaches least far, rounded up.
  using Depth = std::uint8_t;
  static constexpr double most_depth = 254;  ///< and one for roundings
  double nothing_before_ = 0, steps_per_m_ = 0;
  /// Per cell the largest w·p of its polygons, 0 if none; a cell of the next level is the
  /// largest of 2 × 2 of this one, up to one cell for all.
  struct Level {
    int size;
    std::vector<Depth> farthest;
    Depth& at(int x, int y) { return farthest[place_of(x, y)]; }
    Depth at(int x, int y) const { return farthest[place_of(x, y)]; }
    std::size_t place_of(int x, int y) const {
      return static_cast<std::size_t>(y) * static_cast<std::size_t>(size) +
             static_cast<std::size_t>(x);
    }
  };
  std::vector<Level> levels_;
};

}  // namespace sunload
