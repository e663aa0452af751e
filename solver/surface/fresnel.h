// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Reflection and transmission of smooth surfaces by Fresnel's formulas, for unpolarised light.
///
/// Light is taken as unpolarised at every surface that it meets (docs/developer/method.md,
/// Surfaces): both polarisations are followed through a stack of panes, then averaged.
/// References: Born & Wolf (1999), Principles of Optics, 1.5 and 14.2; Duffie & Beckman (2013),
/// Solar Engineering of Thermal Processes, 5.1–5.3.
#pragma once

namespace sunload {

/// Shares of the power that arrives; what is left over is absorbed.
struct PaneShares {
  double reflected = 1, transmitted = 0;
};

/// Plane-parallel panes in air, with all reflections between their faces.
struct PaneStack {
  double refractive_index = 1.52;  ///< n > 1
  double absorption = 0;  ///< K·L, absorption coefficient times thickness of one pane ≥ 0
  int count = 1;          ///< equal panes one behind the other
};

/// At the angle of incidence whose cosine is `cos_theta`, 0 … 1. Grazing light is reflected.
/// With r of one face, τ = exp(-KL/cosθ_t), per polarisation of one pane:
///
///     R = r + r τ² (1-r)² / (1 - r² τ²)        T = τ (1-r)² / (1 - r² τ²)
///
/// and a pane (2) behind panes (1):  T = T₁T₂ / (1 - R₁R₂),  R = R₁ + T₁² R₂ / (1 - R₁R₂).
PaneShares pane_shares(const PaneStack& panes, double cos_theta);

/// Reflectance of a smooth metal of complex refractive index n + i k in air (n > 0, k ≥ 0).
double metal_reflectance(double n, double k, double cos_theta);

}  // namespace sunload
