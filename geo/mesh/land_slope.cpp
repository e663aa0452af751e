// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "geo/mesh/land_slope.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geo/base/check.h"

namespace sunload {

namespace {

constexpr double unknowns = 3;    // of a plane
constexpr double thin = 1e-4;     // of the variances in plan: lines as good as one line
constexpr double steepest = 1.0;  // 45 degrees, as between feet

struct Moments {
  double weight = 0, squares = 0;  ///< of bodies: their sum, and of their squares
  double x = 0, y = 0, z = 0;      ///< means
  double xx = 0, xy = 0, yy = 0, xz = 0, yz = 0, zz = 0;
};

/// Slope along the directions in which the lines extend: by eigenvectors of their variance in plan.
LandSlope fitted_slope(const Moments& m) {
  const double middle = (m.xx + m.yy) / 2, radius = std::hypot((m.xx - m.yy) / 2, m.xy);
  const double angle = std::atan2(2 * m.xy, m.xx - m.yy) / 2;
  LandSlope slope;
  for (const bool is_larger : {true, false}) {
    const double variance = is_larger ? middle + radius : middle - radius;
    if (!(variance > thin * (middle + radius))) continue;
    const double ux = is_larger ? std::cos(angle) : -std::sin(angle),
                 uy = is_larger ? std::sin(angle) : std::cos(angle);
    const double along = (ux * m.xz + uy * m.yz) / variance;
    slope.x += along * ux;
    slope.y += along * uy;
  }
  return slope;
}

}  // namespace

LandSlopes::LandSlopes(const LandLines& lines) {
  SUNLOAD_EXPECT(lines.foot_body.size() == lines.feet.size(), "every foot has a body");
  std::vector<std::size_t> order(lines.feet.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return lines.foot_body[a] < lines.foot_body[b];
  });
  const auto add = [&](const Segment& line) {
    const double half = std::hypot(line[1].x - line[0].x, line[1].y - line[0].y) / 2;
    for (const Vec3 end : line) ends_.push_back({end, half});
  };
  for (const Segment& rim : lines.rims) {
    body_begin_.push_back(ends_.size());
    add(rim);
  }
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || lines.foot_body[order[i]] != lines.foot_body[order[i - 1]])
      body_begin_.push_back(ends_.size());
    add(lines.feet[order[i]]);
  }
  body_begin_.push_back(ends_.size());
}

LandSlope LandSlopes::around(double x, double y) const {
  Moments m;
  const auto weight = [&](const End& end) {
    const double dx = (end.at.x - x) / slope_reach_m, dy = (end.at.y - y) / slope_reach_m;
    return end.length / (1 + dx * dx + dy * dy) / (1 + dx * dx + dy * dy);
  };
  for (std::size_t b = 0; b + 1 < body_begin_.size(); ++b) {
    double of_body = 0;
    for (std::size_t e = body_begin_[b]; e < body_begin_[b + 1]; ++e) {
      const double w = weight(ends_[e]);
      of_body += w;
      m.x += w * ends_[e].at.x, m.y += w * ends_[e].at.y, m.z += w * ends_[e].at.z;
    }
    m.weight += of_body;
    m.squares += of_body * of_body;
  }
  if (!(m.weight > 0)) return {};
  m.x /= m.weight, m.y /= m.weight, m.z /= m.weight;
  for (const End& end : ends_) {
    const double w = weight(end);
    const double dx = end.at.x - m.x, dy = end.at.y - m.y, dz = end.at.z - m.z;
    m.xx += w * dx * dx, m.xy += w * dx * dy, m.yy += w * dy * dy;
    m.xz += w * dx * dz, m.yz += w * dy * dz, m.zz += w * dz * dz;
  }
  if (!(m.zz > 0)) return {};
  const LandSlope plane = fitted_slope(m);
  const double left = std::max(m.zz - plane.x * m.xz - plane.y * m.yz, 0.0) / m.zz;
  const double bodies = m.weight * m.weight / m.squares;
  // Adjusted by the degrees of freedom (Ezekiel 1930).
  const double explained =
      bodies > unknowns ? 1 - left * (bodies - 1) / (bodies - unknowns) : (left < thin ? 1 : 0);
  const double share = explained > 0 ? explained * explained : 0;
  const double rise = std::hypot(plane.x, plane.y);
  const double factor = rise > steepest ? share * steepest / rise : share;
  return {factor * plane.x, factor * plane.y};
}

}  // namespace sunload
