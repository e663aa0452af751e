// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/first_light/beam_raster.h"

#include <algorithm>
#include <array>
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
    : w_(w), spread_(spread), size_(size), farthest_of_all_(nowhere) {
  for (int cells = size;; cells = (cells + 1) / 2) {
    levels_.push_back({cells, std::vector<float>(static_cast<std::size_t>(cells * cells),
                                                 static_cast<float>(nowhere))});
    if (cells == 1) break;
  }
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
        float& farthest = levels_[0].at(x, y);
        farthest = std::max(farthest, reach);
      }
  }
  for (std::size_t l = 1; l < levels_.size(); ++l) {
    Level& finer = levels_[l - 1];
    for (int y = 0; y < finer.size; ++y)
      for (int x = 0; x < finer.size; ++x) {
        float& farthest = levels_[l].at(x / 2, y / 2);
        farthest = std::max(farthest, finer.at(x, y));
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
  if (r.x0 > r.x1) return false;
  // At most 2 × 2 blocks of this level hold the range; those that lie partly in it are
  // looked at by their quarters.
  int first = 0;
  while ((r.x1 >> first) - (r.x0 >> first) > 1 || (r.y1 >> first) - (r.y0 >> first) > 1) ++first;
  struct Block {
    int level, x, y;
  };
  constexpr std::size_t most_levels = 32;
  std::array<Block, 4 * most_levels> left;
  std::size_t count = 0;
  const auto add_in_range = [&](int level, int x0, int y0) {
    for (int y = y0; y <= y0 + 1; ++y)
      for (int x = x0; x <= x0 + 1; ++x)
        if (x <= r.x1 >> level && x >= r.x0 >> level && y <= r.y1 >> level && y >= r.y0 >> level)
          left[count++] = {level, x, y};
  };
  add_in_range(first, r.x0 >> first, r.y0 >> first);
  while (count > 0) {
    const auto [level, x, y] = left[--count];
    const float farthest = levels_[static_cast<std::size_t>(level)].at(x, y);
    if (!(static_cast<double>(farthest) > r.nearest)) continue;
    const int x0 = x << level, x1 = ((x + 1) << level) - 1;
    const int y0 = y << level, y1 = ((y + 1) << level) - 1;
    if (x0 >= r.x0 && x1 <= r.x1 && y0 >= r.y0 && y1 <= r.y1) return true;
    add_in_range(level - 1, 2 * x, 2 * y);
  }
  return false;
}

}  // namespace sunload
