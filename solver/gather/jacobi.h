// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Gathering stochastic Jacobi on lines traced once.
///
///     E^(0) = E_0           E^(b) = E_0 + G (rho E^(b-1)),   b = 1 … bounces
///
/// with G the links of the lines (an estimate of the form factors) and E_0
/// everything that arrives without diffuse reflection. Light reflected
/// diffusely 1 … bounces times is followed; rho (E^(n) - E^(n-1)) is left. What that
/// brings, E^(∞) - E^(n), can be estimated (solver/gather/unfollowed.h).
/// Reusing the lines in every iteration is unbiased for two transports and
/// biased by O(1/lines) after (Bekaert 1999; docs/developer/method.md, Gathering).
/// Links that stand for all reflections (LineSet::all_reflections) are gathered over once, for any
/// number of bounces above 0, and leave nothing.
#pragma once

#include <span>
#include <vector>

#include "solver/light/sun_block.h"
#include "solver/lines/lines.h"
#include "solver/mesh/patch_optics.h"

namespace sunload {

/// out[i] = before[i] + Σ_links w · source[target], for all suns of a block.
void gather_onto(const LinkTable& links, const Columns& source, const Columns& before,
                 Columns& out);
/// The same for one column in double.
void gather_onto(const LinkTable& links, const std::vector<double>& source,
                 const std::vector<double>& before, std::vector<double>& out);

/// out[i] (+)= Σ_links w · source[target], for all suns of a block.
enum class Into { replace, add };
void gather(const LinkTable& links, const Columns& source, Columns& out, Into into);
/// The same for one column in double.
void gather(const LinkTable& links, const std::vector<double>& source, std::vector<double>& out,
            Into into);

/// How far diffuse reflections are followed, and how the rest is estimated. `beyond`: light_beyond
/// of every patch (solver/gather/unfollowed.h); empty: the rest is left out.
struct BounceRules {
  int bounces;
  std::span<const float> beyond;
};

/// Diffusely reflected irradiance.
template <class Irradiance>
struct ReflectedLight {
  Irradiance irradiance;          ///< after a diffuse reflection, and of the far ground, of patches
  Irradiance gathered_radiosity;  ///< rho E^(n-1), which was gathered last, of elements
  Irradiance before;              ///< `irradiance` one bounce earlier; empty without a bounce
  Irradiance two_before;          ///< the same of two bounces
};
using Reflected = ReflectedLight<Columns>;                      ///< of a block of suns [W m-2]
using ReflectedExposure = ReflectedLight<std::vector<double>>;  ///< of a realization [J m-2]

/// base: irradiance that arrives without diffuse reflection (direct, sky, mirror,
/// lamps); ground: that of the far ground.
Reflected reflect(const Hierarchy& mesh, const LineSet& lines, const PatchOptics& optics,
                  const Columns& base, const Columns& ground, int bounces);
/// The same for time-integrated irradiance.
ReflectedExposure reflect(const Hierarchy& mesh, const LineSet& lines, const PatchOptics& optics,
                          const std::vector<double>& base, const std::vector<double>& ground,
                          int bounces);

}  // namespace sunload
