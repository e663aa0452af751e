// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/surface/luminaire.h"

#include <cmath>

#include "geo/base/units.h"

namespace sunload {

Luminaire::Luminaire(Vec3 at, Vec3 towards, double turn_rad) : position(at), axis(towards) {
  const Vec3 down{0, 0, -1};
  const Vec3 x{std::cos(turn_rad), std::sin(turn_rad), 0}, y{-x.y, x.x, 0};
  // The smallest turn from down to the axis; straight up: about the direction of C 0.
  const Vec3 about = cross(down, axis);
  const double sine = norm(about), cosine = dot(down, axis);
  const Vec3 k = sine > 0 ? about / sine : x;
  const auto turned = [&](Vec3 v) {  // Rodrigues' formula
    return v * cosine + cross(k, v) * sine + k * (dot(k, v) * (1 - cosine));
  };
  plane_0 = turned(x);
  plane_90 = turned(y);
}

double Luminaires::intensity(const Luminaire& luminaire, Vec3 direction) const {
  const IntensityWeb& web = webs[luminaire.web];
  const double x = dot(direction, luminaire.plane_0), y = dot(direction, luminaire.plane_90);
  const double gamma =
      std::atan2(std::hypot(x, y), dot(direction, luminaire.axis)) / radians_per_degree;
  double plane = 0;
  if (web.planes_deg.size() > 1) {
    plane = std::atan2(y, x) / radians_per_degree;
    if (plane < 0) plane += 360;
  }
  return luminaire.scale * web.at(plane, gamma);
}

double Luminaires::flux() const {
  double flux = 0;
  for (const Luminaire& each : all) flux += each.scale * webs[each.web].flux();
  return flux;
}

}  // namespace sunload
