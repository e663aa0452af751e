// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Clear glass of which no more is known than its transmittance at normal incidence.
#pragma once

#include <algorithm>
#include <cmath>

namespace sunload {

/// Of light from the normal itself the formula lets this times T₀ pass.
inline constexpr double clear_glass_factor = 1.018;

/// Transmittance at the angle of incidence whose cosine is `cos_theta`, 0 … 1, of glass of normal
/// transmittance T₀ (Rivero 1958):
///
///     T(θ) = 1.018 T₀ cosθ (1 + sin³θ)
///
/// dT/dθ = 1.018 T₀ sinθ (sin 3θ - 1) is nowhere positive: no light passes more easily than that
/// from the normal.
inline double clear_glass_transmittance(double normal_transmittance, double cos_theta) {
  const double c = std::clamp(cos_theta, 0.0, 1.0), sin2 = 1 - c * c;
  return clear_glass_factor * normal_transmittance * c * (1 + sin2 * std::sqrt(sin2));
}

/// The largest T₀ of glass that reflects the share `reflected`: all else would pass it.
inline double largest_normal_transmittance(double reflected) {
  return (1 - reflected) / clear_glass_factor;
}

}  // namespace sunload
