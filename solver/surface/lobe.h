// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Glossy reflection: a lobe of power cosine about the direction of mirror reflection.
///
///     f_r(w_in, w_out) = ρ_g (n + 2) / (2π) · max(0, r·w_out)^n,   r = w_in mirrored
///
/// the modified Phong model of Lewis (1994), Making shaders more physically plausible, as
/// Lafortune & Willems (1994), Using the modified Phong reflectance model for physically based
/// rendering, sample it. Symmetric in both directions (r·w_out = w_in·(w_out mirrored)); of
/// light from the normal it reflects ρ_g, of slanting light less, since the horizon cuts the
/// lobe: never more than ρ_g.
#pragma once

#include <algorithm>
#include <cmath>

#include "geo/base/units.h"
#include "geo/base/vec.h"
#include "solver/base/sampling.h"

namespace sunload {

/// Direction about +z with density (n + 1)/(2π) cos^n α.
inline Vec3 sample_power_cosine(double u, double v, double n) {
  const double cos_a = std::pow(1 - u, 1 / (n + 1));
  const double sin_a = std::sqrt(std::max(0.0, 1 - cos_a * cos_a));
  return {sin_a * std::cos(2 * pi * v), sin_a * std::sin(2 * pi * v), cos_a};
}
inline double power_cosine_pdf(double cos_a, double n) {
  return cos_a > 0 ? (n + 1) / (2 * pi) * std::pow(cos_a, n) : 0;
}
/// The (u, v) that sample_power_cosine maps to this unit direction (w.z ≥ 0).
inline UnitSquare invert_power_cosine(Vec3 w, double n) {
  const double turn = std::atan2(w.y, w.x) / (2 * pi);
  return {1 - std::pow(w.z, n + 1), turn < 0 ? turn + 1 : turn};
}

/// f_r / ρ_g [sr-1]; `cos_a` is that of the angle to the mirrored direction.
inline double lobe_value(double cos_a, double n) {
  return cos_a > 0 ? (n + 2) / (2 * pi) * std::pow(cos_a, n) : 0;
}

/// f_r cosθ / (ρ_g pdf) of a sampled direction, where cosθ is that to the normal; 0 below it.
inline double lobe_sample_weight(double cos_theta, double n) {
  return (n + 2) / (n + 1) * std::max(0.0, cos_theta);
}

}  // namespace sunload
