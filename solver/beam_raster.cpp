#include "solver/beam_raster.h"

#include <algorithm>
#include <limits>

namespace sunload {

namespace {
constexpr double nowhere = -std::numeric_limits<double>::infinity();
}

BeamRaster::BeamRaster(const Mesh& mesh, const std::vector<std::int32_t>& triangles, Vec3 w)
    : w_(w), farthest_(static_cast<std::size_t>(size) * size, nowhere) {
  const Tangents axes = tangents(w);
  x_axis_ = axes.tangent;
  y_axis_ = axes.bitangent;
  double x1 = nowhere, y1 = nowhere;
  x0_ = y0_ = -nowhere;
  for (const auto t : triangles) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = mesh.corner(static_cast<std::size_t>(t), k);
      x0_ = std::min(x0_, dot(p, x_axis_));
      x1 = std::max(x1, dot(p, x_axis_));
      y0_ = std::min(y0_, dot(p, y_axis_));
      y1 = std::max(y1, dot(p, y_axis_));
    }
  }
  // A raster of no extent (mirrors seen edge-on) still needs a finite scale.
  constexpr double smallest_extent_m = 1e-6;
  cells_per_x_ = size / std::max(x1 - x0_, smallest_extent_m);
  cells_per_y_ = size / std::max(y1 - y0_, smallest_extent_m);
  for (const auto t : triangles) {
    const auto i = static_cast<std::size_t>(t);
    const Range r = range(mesh.corner(i, 0), mesh.corner(i, 1), mesh.corner(i, 2));
    for (int y = r.y0; y <= r.y1; ++y)
      for (int x = r.x0; x <= r.x1; ++x) {
        double& farthest = farthest_[static_cast<std::size_t>(y * size + x)];
        farthest = std::max(farthest, r.farthest);
      }
  }
}

BeamRaster::Range BeamRaster::range(Vec3 a, Vec3 b, Vec3 c) const {
  double x[2] = {-nowhere, nowhere}, y[2] = {-nowhere, nowhere}, z[2] = {-nowhere, nowhere};
  for (const Vec3 p : {a, b, c}) {
    const double px = (dot(p, x_axis_) - x0_) * cells_per_x_;
    const double py = (dot(p, y_axis_) - y0_) * cells_per_y_;
    const double pz = dot(p, w_);
    x[0] = std::min(x[0], px), x[1] = std::max(x[1], px);
    y[0] = std::min(y[0], py), y[1] = std::max(y[1], py);
    z[0] = std::min(z[0], pz), z[1] = std::max(z[1], pz);
  }
  const auto cell = [](double v) { return static_cast<int>(std::clamp(v, 0.0, size - 1.0)); };
  if (x[1] < 0 || x[0] > size || y[1] < 0 || y[0] > size) return {1, 0, 1, 0, z[0], z[1]};
  return {cell(x[0]), cell(x[1]), cell(y[0]), cell(y[1]), z[0], z[1]};
}

bool BeamRaster::may_meet(Vec3 a, Vec3 b, Vec3 c) const {
  const Range r = range(a, b, c);
  for (int y = r.y0; y <= r.y1; ++y)
    for (int x = r.x0; x <= r.x1; ++x)
      if (farthest_[static_cast<std::size_t>(y * size + x)] > r.nearest) return true;
  return false;
}

}  // namespace sunload
