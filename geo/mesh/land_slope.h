// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// By what slope land goes on beyond the lines that it goes through.
#pragma once

#include <vector>

#include "geo/mesh/land.h"

namespace sunload {

/// Lines count by half at this distance in the slope of the land, and beyond it less and less; land
/// goes on by that slope as far.
inline constexpr double slope_reach_m = 100;

/// Of heights, as x and y grow: dz/dx, dz/dy.
struct LandSlope {
  double x = 0, y = 0;
};

/// The plane that fits the lines around a point, by their lengths (weighted least squares), times
/// the square of the share of the heights' variance that it explains, with as many observations as
/// there are bodies. Houses on a plane slope give it in full; houses that stand now higher, now
/// lower give next to none, nor do two or three level ones. No steeper than 45 degrees; across
/// lines that are as good as one line in plan it is not known, and 0.
class LandSlopes {
 public:
  explicit LandSlopes(const LandLines& lines);
  LandSlope around(double x, double y) const;

 private:
  struct End {
    Vec3 at;
    double length;  ///< half of its line's
  };
  std::vector<End> ends_;
  std::vector<std::size_t> body_begin_;  ///< the ends of body b begin here; one more at the end
};

}  // namespace sunload
