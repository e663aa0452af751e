// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/first_light/beam_raster.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sunload {

namespace {

constexpr double nowhere = -std::numeric_limits<double>::infinity();

/// The float not below a number.
float rounded_up(double value) {
  const auto nearest = static_cast<float>(value);
  return static_cast<double>(nearest) < value
             ? std::nextafter(nearest, std::numeric_limits<float>::infinity())
             : nearest;
}

}  // namespace

BeamRaster::BeamRaster(std::span<const ConvexPolygon> section, Vec3 w, double spread, int size)
    : w_(w),
      spread_(spread),
      size_(size),
      farthest_of_all_(nowhere),
      farthest_(static_cast<std::size_t>(size * size), static_cast<float>(nowhere)) {
  const Tangents axes = tangents(w);
  x_axis_ = axes.tangent;
  y_axis_ = axes.bitangent;
  double x1 = nowhere, y1 = nowhere;
  x0_ = y0_ = -nowhere;
  for (const auto& polygon : section)
    for (const Vec3 p : polygon) {
      x0_ = std::min(x0_, dot(p, x_axis_));
      x1 = std::max(x1, dot(p, x_axis_));
      y0_ = std::min(y0_, dot(p, y_axis_));
      y1 = std::max(y1, dot(p, y_axis_));
    }
  // A raster of no extent (mirrors seen edge-on) still needs a finite scale.
  constexpr double smallest_extent_m = 1e-6;
  cells_per_x_ = size / std::max(x1 - x0_, smallest_extent_m);
  cells_per_y_ = size / std::max(y1 - y0_, smallest_extent_m);
  for (const auto& polygon : section) {
    const Range r = range(polygon, 0);
    farthest_of_all_ = std::max(farthest_of_all_, r.farthest);
    const float reach = rounded_up(r.farthest);
    for (int y = r.y0; y <= r.y1; ++y)
      for (int x = r.x0; x <= r.x1; ++x) {
        float& farthest = farthest_[static_cast<std::size_t>(y * size_ + x)];
        farthest = std::max(farthest, reach);
      }
  }
}

BeamRaster::Range BeamRaster::range(std::span<const Vec3> points, double spread) const {
  double x[2] = {-nowhere, nowhere}, y[2] = {-nowhere, nowhere}, z[2] = {-nowhere, nowhere};
  for (const Vec3 p : points) {
    const double px = (dot(p, x_axis_) - x0_) * cells_per_x_;
    const double py = (dot(p, y_axis_) - y0_) * cells_per_y_;
    const double pz = dot(p, w_);
    x[0] = std::min(x[0], px), x[1] = std::max(x[1], px);
    y[0] = std::min(y[0], py), y[1] = std::max(y[1], py);
    z[0] = std::min(z[0], pz), z[1] = std::max(z[1], pz);
  }
  if (spread > 0) {
    const double beside_m = spread * std::max(0.0, farthest_of_all_ - z[0]);
    x[0] -= beside_m * cells_per_x_, x[1] += beside_m * cells_per_x_;
    y[0] -= beside_m * cells_per_y_, y[1] += beside_m * cells_per_y_;
  }
  const auto cell = [&](double v) { return static_cast<int>(std::clamp(v, 0.0, size_ - 1.0)); };
  if (x[1] < 0 || x[0] > size_ || y[1] < 0 || y[0] > size_) return {1, 0, 1, 0, z[0], z[1]};
  return {cell(x[0]), cell(x[1]), cell(y[0]), cell(y[1]), z[0], z[1]};
}

bool BeamRaster::may_meet(std::span<const Vec3> points) const {
  const Range r = range(points, spread_);
  for (int y = r.y0; y <= r.y1; ++y)
    for (int x = r.x0; x <= r.x1; ++x)
      if (static_cast<double>(farthest_[static_cast<std::size_t>(y * size_ + x)]) > r.nearest)
        return true;
  return false;
}

}  // namespace sunload
