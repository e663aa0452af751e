/// Which receivers can lie in the beam that a set of triangles sends along a
/// direction: a conservative raster of the triangles seen along it.
#pragma once

#include <vector>

#include "geo/mesh.h"

namespace sunload {

class BeamRaster {
 public:
  /// Raster of `triangles` seen from far away along the unit direction `w`
  /// (from receivers to the triangles).
  BeamRaster(const Mesh& mesh, const std::vector<std::int32_t>& triangles, Vec3 w);
  /// False only if no point of the triangle (a, b, c) has one of the triangles
  /// ahead of it along w.
  bool may_meet(Vec3 a, Vec3 b, Vec3 c) const;

 private:
  static constexpr int size = 256;
  struct Range {
    int x0, x1, y0, y1;
    double nearest, farthest;  ///< along w
  };
  Range range(Vec3 a, Vec3 b, Vec3 c) const;

  Vec3 x_axis_, y_axis_, w_;
  double x0_ = 0, y0_ = 0, cells_per_x_ = 0, cells_per_y_ = 0;
  std::vector<double> farthest_;  ///< per cell: largest w·p of its triangles, -inf if none
};

}  // namespace sunload
