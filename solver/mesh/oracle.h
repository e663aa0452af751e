// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What decides whether an element is fine enough: pure functions.
///
/// Of the two ways to refine, the default bounds the error that constant light on leaves makes in
/// the light load; the historic one is the disc estimate of the form factor alone
/// (docs/developer/method.md, The historic system).
#pragma once

#include <cstdint>

#include "geo/base/units.h"
#include "solver/mesh/bisection.h"

namespace sunload {

/// By what an element is split beyond the longest edge that is allowed; none: by nothing else.
enum class Oracle { none, light_load, historic };

/// Of the pilot alone: a study's seed does not touch its mesh, so that runs of any seed have the
/// same patches.
inline constexpr std::uint64_t mesh_pilot_seed = 1;

/// Thresholds of both oracles; those of the other one are not used.
struct RefineRules {
  Oracle oracle = Oracle::none;
  double light_tolerance = 0.07;       ///< of the default oracle, share of the mean light load
  double light_threshold_m2 = 0.005;   ///< F1_eps of the historic one
  double form_factor_threshold = 0.5;  ///< F_eps of the historic one, for light of emitters
  TVertices t_vertices = TVertices::remove;
  std::uint64_t seed = mesh_pilot_seed;
};

/// Historic oracle of the light iteration, the form factor's estimate without distance: an area
/// [m2], cosθ·A/π. A lit element is split while it exceeds the threshold F1_eps.
constexpr double historic_light_estimate_m2(double cos_theta, double area_m2) {
  return cos_theta * area_m2 / pi;
}

/// Largest form factor that an element inside of a sphere can have as seen from a point at the
/// distance of its centre: that of the sphere's disc at its nearest, (r / (d - r))², whatever the
/// angles; 1 where that is no bound. The historic oracle's disc estimate without its cosine, which
/// at the centre loses elements that lie partly in front (docs/developer/method.md, Mesh).
/// Visibility is ignored.
constexpr double largest_form_factor(double radius_m, double distance_m) {
  const double nearest = distance_m - radius_m;
  return nearest > radius_m ? (radius_m / nearest) * (radius_m / nearest) : 1;
}

/// What an element adds to the squared error of the light load on a mesh of constant leaves,
/// ∫ (H - mean H)² dA [J2 m-2].
constexpr double squared_error(double variance, double area_m2) { return variance * area_m2; }

}  // namespace sunload
