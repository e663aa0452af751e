// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/first_light/beam_raster.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "geo/base/vector_code.h"

namespace sunload {

namespace {

constexpr double nowhere = -std::numeric_limits<double>::infinity();

}  // namespace

void TriangleColumns::add(const std::array<Vec3, 3>& corners) {
  for (std::size_t c = 0; c < 3; ++c) {
    x[c][count] = corners[c].x;
    y[c][count] = corners[c].y;
    z[c][count] = corners[c].z;
  }
  ++count;
}

struct BeamRaster::Extents {
  alignas(64) double x0[TriangleColumns::most], x1[TriangleColumns::most];
  alignas(64) double y0[TriangleColumns::most], y1[TriangleColumns::most];
  alignas(64) double nearest[TriangleColumns::most], farthest[TriangleColumns::most];
};

BeamRaster::BeamRaster(std::span<const ConvexPolygon> section, Vec3 w, double spread, int size)
    : frame_{tangents(w).tangent, tangents(w).bitangent, w},
      spread_(spread),
      size_(size),
      farthest_of_all_(nowhere) {
  for (int cells = size;; cells = (cells + 1) / 2) {
    levels_.push_back({cells, std::vector<Depth>(static_cast<std::size_t>(cells * cells), 0)});
    if (cells == 1) break;
  }
  double x1 = nowhere, y1 = nowhere;
  frame_.x0 = frame_.y0 = -nowhere;
  for (const auto& polygon : section)
    for (const Vec3 p : polygon) {
      frame_.x0 = std::min(frame_.x0, dot(p, frame_.x_axis));
      x1 = std::max(x1, dot(p, frame_.x_axis));
      frame_.y0 = std::min(frame_.y0, dot(p, frame_.y_axis));
      y1 = std::max(y1, dot(p, frame_.y_axis));
    }
  // A raster of no extent (mirrors seen edge-on) still needs a finite scale.
  constexpr double smallest_extent_m = 1e-6;
  frame_.cells_per_x = size / std::max(x1 - frame_.x0, smallest_extent_m);
  frame_.cells_per_y = size / std::max(y1 - frame_.y0, smallest_extent_m);
  std::vector<Range> parts;
  double least = -nowhere;
  for (const auto& polygon : section) {
    parts.push_back(range(polygon, 0));
    least = std::min(least, parts.back().farthest);
    farthest_of_all_ = std::max(farthest_of_all_, parts.back().farthest);
  }
  nothing_before_ = least;
  steps_per_m_ = most_depth / std::max(farthest_of_all_ - least, smallest_extent_m);
  for (const Range& r : parts) fill(r);
  for (std::size_t l = 1; l < levels_.size(); ++l) {
    Level& finer = levels_[l - 1];
    for (int y = 0; y < finer.size; ++y)
      for (int x = 0; x < finer.size; ++x) {
        Depth& farthest = levels_[l].at(x / 2, y / 2);
        farthest = std::max(farthest, finer.at(x, y));
      }
  }
}

void BeamRaster::fill(const Range& r) {
  // Never below what it stands for: a rounding more is less than that share of a step.
  constexpr double rounding = 1e-6;
  const double steps = std::ceil((r.farthest - nothing_before_) * steps_per_m_ + rounding);
  const auto reach = static_cast<Depth>(std::min<double>(steps, std::numeric_limits<Depth>::max()));
  for (int y = r.y0; y <= r.y1; ++y) {
    Depth* const row = &levels_[0].at(0, y);
    for (int x = r.x0; x <= r.x1; ++x) row[x] = std::max(row[x], reach);
  }
}

BeamRaster::Range BeamRaster::range(std::span<const Vec3> points, double spread) const {
  Extent extent{-nowhere, nowhere, -nowhere, nowhere, -nowhere, nowhere};
  for (const Vec3 p : points) {
    const double x = (dot(p, frame_.x_axis) - frame_.x0) * frame_.cells_per_x;
    const double y = (dot(p, frame_.y_axis) - frame_.y0) * frame_.cells_per_y;
    const double z = dot(p, frame_.w);
    extent = {std::min(extent.x0, x), std::max(extent.x1, x),      std::min(extent.y0, y),
              std::max(extent.y1, y), std::min(extent.nearest, z), std::max(extent.farthest, z)};
  }
  return range(extent, spread);
}

/// Empty beside the raster.
BeamRaster::Range BeamRaster::range(Extent extent, double spread) const {
  auto [x0, x1, y0, y1, nearest, farthest] = extent;
  if (spread > 0) {
    const double beside_m = spread * std::max(0.0, farthest_of_all_ - nearest);
    x0 -= beside_m * frame_.cells_per_x, x1 += beside_m * frame_.cells_per_x;
    y0 -= beside_m * frame_.cells_per_y, y1 += beside_m * frame_.cells_per_y;
  }
  if (x1 < 0 || x0 > size_ || y1 < 0 || y0 > size_) return {1, 0, 1, 0, nearest, farthest};
  const auto cell = [&](double v) { return static_cast<int>(std::clamp(v, 0.0, size_ - 1.0)); };
  return {cell(x0), cell(x1), cell(y0), cell(y1), nearest, farthest};
}

// In the shape that compilers turn into vector code.
SUNLOAD_VECTOR_CODE void BeamRaster::find_extents(const TriangleColumns& __restrict triangles,
                                                  const Frame& __restrict frame,
                                                  Extents& __restrict out) {
  const auto [ux, uy, uz] = frame.x_axis;
  const auto [vx, vy, vz] = frame.y_axis;
  const auto [wx, wy, wz] = frame.w;
  const double u0 = frame.x0, v0 = frame.y0, per_u = frame.cells_per_x, per_v = frame.cells_per_y;
  for (std::size_t l = 0; l < TriangleColumns::most; ++l) {
    double u[3], v[3], w[3];
    for (std::size_t c = 0; c < 3; ++c) {
      const double x = triangles.x[c][l], y = triangles.y[c][l], z = triangles.z[c][l];
      u[c] = (x * ux + y * uy + z * uz - u0) * per_u;
      v[c] = (x * vx + y * vy + z * vz - v0) * per_v;
      w[c] = x * wx + y * wy + z * wz;
    }
    out.x0[l] = std::min(std::min(u[0], u[1]), u[2]);
    out.x1[l] = std::max(std::max(u[0], u[1]), u[2]);
    out.y0[l] = std::min(std::min(v[0], v[1]), v[2]);
    out.y1[l] = std::max(std::max(v[0], v[1]), v[2]);
    out.nearest[l] = std::min(std::min(w[0], w[1]), w[2]);
    out.farthest[l] = std::max(std::max(w[0], w[1]), w[2]);
  }
}

std::uint64_t BeamRaster::may_meet_each(const TriangleColumns& triangles,
                                        std::uint64_t asked) const {
  if (asked == 0) return 0;
  Extents of;
  find_extents(triangles, frame_, of);
  std::uint64_t met = 0;
  for (; asked != 0; asked &= asked - 1) {
    const auto l = static_cast<std::size_t>(std::countr_zero(asked));
    const Range of_triangle =
        range({of.x0[l], of.x1[l], of.y0[l], of.y1[l], of.nearest[l], of.farthest[l]}, spread_);
    if (may_meet(of_triangle)) met |= std::uint64_t{1} << l;
  }
  return met;
}

bool BeamRaster::may_meet(std::span<const Vec3> points) const {
  return may_meet(range(points, spread_));
}

bool BeamRaster::may_meet(const Range& r) const {
  if (r.x0 > r.x1 || r.nearest >= farthest_of_all_) return false;
  const double steps = std::max(0.0, (r.nearest - nothing_before_) * steps_per_m_);
  // What is told of depths below the nearest polygon is that there are some.
  const auto nearest = static_cast<int>(std::min<double>(steps, most_depth));
  constexpr int few_cells = 64;
  return (r.x1 - r.x0 + 1) * (r.y1 - r.y0 + 1) <= few_cells ? any_beyond(r, nearest)
                                                            : any_beyond_by_levels(r, nearest);
}

bool BeamRaster::any_beyond(const Range& r, int nearest) const {
  for (int y = r.y0; y <= r.y1; ++y)
    for (int x = r.x0; x <= r.x1; ++x)
      if (levels_[0].at(x, y) > nearest) return true;
  return false;
}

bool BeamRaster::any_beyond_by_levels(const Range& r, int nearest) const {
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
    if (levels_[static_cast<std::size_t>(level)].at(x, y) <= nearest) continue;
    const int x0 = x << level, x1 = ((x + 1) << level) - 1;
    const int y0 = y << level, y1 = ((y + 1) << level) - 1;
    if (x0 >= r.x0 && x1 <= r.x1 && y0 >= r.y0 && y1 <= r.y1) return true;
    add_in_range(level - 1, 2 * x, 2 * y);
  }
  return false;
}

}  // namespace sunload
