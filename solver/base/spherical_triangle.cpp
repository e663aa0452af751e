// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/base/spherical_triangle.h"

#include <algorithm>
#include <cmath>

#include "geo/base/units.h"

namespace sunload {

namespace {

/// Unit vector of what of v is across the unit vector w; 0 where nothing is.
Vec3 across(Vec3 v, Vec3 w) {
  const Vec3 rest = v - w * dot(v, w);
  const double length = norm(rest);
  return length > 0 ? rest / length : Vec3{0, 0, 0};
}

}  // namespace

SphericalTriangle::SphericalTriangle(Vec3 a, Vec3 b, Vec3 c)
    : a_(normalized(a)), b_(normalized(b)) {
  const Vec3 unit_c = normalized(c);
  const double volume = std::abs(dot(a_, cross(b_, unit_c)));
  solid_angle_ = 2 * std::atan2(volume, 1 + dot(a_, b_) + dot(b_, unit_c) + dot(unit_c, a_));
  towards_c_ = across(unit_c, a_);
  const Vec3 towards_b = across(b_, a_);
  cos_c_ = dot(a_, b_);
  sin_angle_ = norm(cross(towards_b, towards_c_));
  cos_angle_ = dot(towards_b, towards_c_);
  angle_ = std::atan2(sin_angle_, cos_angle_);
}

Vec3 SphericalTriangle::sample(double u, double v) const {
  // The part of the triangle towards b that has the share u of its area ends at a point of arc ac.
  const double turn = u * solid_angle_ - angle_;
  const double s = std::sin(turn), t = std::cos(turn);
  const double p = t - cos_angle_, q = s + sin_angle_ * cos_c_;
  const double below = (q * s + p * t) * sin_angle_;
  const double along =
      below != 0 ? std::clamp(((q * t - p * s) * cos_angle_ - q) / below, -1.0, 1.0) : 1;
  const Vec3 end = a_ * along + towards_c_ * std::sqrt(1 - along * along);
  // From b towards it, uniform in the cosine.
  const Vec3 gap = end - b_;
  const double versine = v * dot(gap, gap) / 2;
  return b_ * (1 - versine) + across(end, b_) * std::sqrt(versine * (2 - versine));
}

}  // namespace sunload
