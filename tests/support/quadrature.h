// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Integrals that tests compare with.
#pragma once

#include <cmath>
#include <functional>

#include "geo/base/units.h"
#include "solver/surface/lobe.h"

namespace sunload::test {

/// Midpoint rule; `steps` of a million leave nothing that a test could see.
inline double integral(double low, double high, int steps, const std::function<double(double)>& f) {
  double sum = 0;
  for (int i = 0; i < steps; ++i) sum += f(low + (high - low) * (i + 0.5) / steps);
  return sum * (high - low) / steps;
}

/// Mean of a share over the hemisphere, weighted with the cosine: ∫ f(cosθ) 2 cosθ d(cosθ).
inline double hemispherical(const std::function<double(double)>& share_of_cosine) {
  return integral(0, 1, 20000, [&](double c) { return 2 * c * share_of_cosine(c); });
}

/// Share of light at cos_theta that the lobe of solver/surface/lobe.h reflects, per ρ_g.
inline double lobe_albedo(double cos_theta, double n) {
  const double sin_theta = std::sqrt(1 - cos_theta * cos_theta);
  constexpr int steps = 200;
  return integral(0, 1, steps, [&](double u) {  // u = cos^(n+1) α: equal parts of the pdf
    const double cos_a = std::pow(u, 1 / (n + 1)), sin_a = std::sqrt(1 - cos_a * cos_a);
    return integral(0, 2 * pi, steps,
                    [&](double phi) {
                      return lobe_sample_weight(
                          cos_a * cos_theta + sin_a * sin_theta * std::cos(phi), n);
                    }) /
           (2 * pi);
  });
}

}  // namespace sunload::test
