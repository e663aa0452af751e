// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/rim_land.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geo/base/units.h"
#include "geo/mesh/plan_lines.h"

namespace sunload {

namespace {

constexpr double widest_m = 100;         ///< of holes: the way to a rim
constexpr double beside_m = 4;           ///< the nearest rim
constexpr int directions = 8, most = 6;  // in a corner outside of terrain there are five
constexpr double least_m = 1e-6;         ///< of a distance: on the rim itself

}  // namespace

RimLand::RimLand(const std::vector<Segment>& rims) : rims_(rims), tree_(tree_in_plan(rims)) {}

std::optional<RimLand::Met> RimLand::first_met(double x, double y, double along_x,
                                               double along_y) const {
  Met nearest{std::numeric_limits<double>::infinity(), 0};
  const Vec3 from{x, y, 0}, to{x + widest_m * along_x, y + widest_m * along_y, 0};
  tree_.visit_meeting(upright(box_around({from, to})), [&](std::size_t i) {
    const auto& [a, b] = rims_[i];
    const double ex = b.x - a.x, ey = b.y - a.y, turn = along_x * ey - along_y * ex;
    if (turn == 0) return;
    const double distance = ((a.x - x) * ey - (a.y - y) * ex) / turn,
                 at = ((a.x - x) * along_y - (a.y - y) * along_x) / turn;
    if (distance < -least_m || distance > widest_m || at < 0 || at > 1) return;
    const Met met{std::max(distance, least_m), a.z + at * (b.z - a.z)};
    // Of equals the lower: whatever the order of rims.
    if (met.distance < nearest.distance || (met.distance == nearest.distance && met.z < nearest.z))
      nearest = met;
  });
  if (std::isinf(nearest.distance)) return std::nullopt;
  return nearest;
}

std::optional<double> RimLand::height_at(double x, double y) const {
  int count = 0;
  double sum = 0, weights = 0, least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < directions; ++k) {
    const double angle = 2 * pi * k / directions;
    const auto met = first_met(x, y, std::cos(angle), std::sin(angle));
    if (!met) continue;
    ++count;
    sum += met->z / met->distance;
    weights += 1 / met->distance;
    least = std::min(least, met->distance);
  }
  if (count < most || least > beside_m) return std::nullopt;
  return sum / weights;
}

}  // namespace sunload
