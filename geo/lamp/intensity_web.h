// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Photometry of a luminaire: what it sends in which direction.
#pragma once

#include <vector>

namespace sunload {

/// Intensity over planes C about a luminaire's axis and angles γ from it (CIE 121): linear between
/// the given ones, nothing beyond the first and last γ.
struct IntensityWeb {
  std::vector<double> planes_deg;   ///< C, ascending: 0 alone (the same in all), or from 0 to 360
  std::vector<double> gammas_deg;   ///< ascending, within 0 … 180; two at least
  std::vector<double> intensities;  ///< [plane][γ], 0 or more [W/sr, or cd]

  double at(double plane_deg, double gamma_deg) const;
  /// Of the whole sphere, exact for what is linear between γ and between C [W, or lm].
  double flux() const;
  double largest() const;
};

/// Throws std::logic_error for a web that is not as described.
void expect_valid(const IntensityWeb& web);

}  // namespace sunload
