/// What decides whether an element is fine enough: pure functions.
///
/// Of the two ways to refine, the default bounds the error that constant light on leaves makes in
/// the light load; the historic one is the disc estimate of the form factor alone (METHOD 3, 4).
#pragma once

#include <cstdint>

#include "geo/units.h"
#include "solver/bisection.h"

namespace sunload {

enum class Oracle { none, light_load, historic };

struct RefineRules {
  Oracle oracle = Oracle::none;
  double light_tolerance = 0.05;      ///< of the default oracle, share of the mean light load
  double light_threshold_m2 = 0.005;  ///< F1_eps of the historic one
  TVertices t_vertices = TVertices::remove;
  std::uint64_t seed = 1;
};

/// Historic oracle of the light iteration, the form factor's estimate without distance: an area
/// [m2], cosθ·A/π. A lit element is split while it exceeds the threshold F1_eps.
constexpr double historic_light_estimate_m2(double cos_theta, double area_m2) {
  return cos_theta * area_m2 / pi;
}

/// Disc estimate of the form factor to an element, cosθ·ω/π with ω the solid angle of a disc of
/// its area that is seen at the angle θ' from the distance r; visibility ignored.
/// `cos_theta_there` is that of θ'. Never above 1.
constexpr double disc_form_factor(double cos_theta, double cos_theta_there, double area_m2,
                                  double distance_m) {
  const double solid_angle = area_m2 * cos_theta_there / (distance_m * distance_m);
  const double estimate = cos_theta * solid_angle / pi;
  return estimate < 1 ? estimate : 1;
}

/// What an element adds to the squared error of the light load on a mesh of constant leaves,
/// ∫ (H - mean H)² dA [J2 m-2].
constexpr double squared_error(double variance, double area_m2) { return variance * area_m2; }

}  // namespace sunload
