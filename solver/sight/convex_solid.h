// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A convex solid by its sides, cut by one plane after the other.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/sight/flat_polygon.h"

namespace sunload {

class ConvexSolid {
 public:
  /// A box by its middle, three unit axes at right angles and half of its lengths along them [m].
  ConvexSolid(Vec3 middle, const std::array<Vec3, 3>& axes, Vec3 half);

  struct Side {
    HalfSpace beyond;  ///< what lies outside of the solid
    std::vector<Vec3> corners;
  };
  std::span<const Side> sides() const { return sides_; }
  /// Whether all sides are further than `depth_m` from the point, which lies inside.
  bool has_within(Vec3 point, double depth_m) const;
  double volume() const;  ///< [m3]

  /// Leaves what does not lie before a plane. Sides that are no more than a line are gone.
  void cut(const HalfSpace& away);
  /// What of a flat convex polygon is inside, further than `depth_m` from all sides.
  std::vector<Vec3> part_within(std::span<const Vec3> polygon, double depth_m) const;

  /// Corners that are nearer than `apart_m` are one.
  struct Frame {
    std::vector<Vec3> corners;
    std::vector<std::array<std::uint8_t, 2>> edges;  ///< numbers of corners
  };
  Frame frame(double apart_m) const;

 private:
  std::vector<Side> sides_;
};

}  // namespace sunload
