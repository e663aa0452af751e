// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Directions from a luminaire to a triangle, drawn by what it sends along them.
///
/// A narrow beam is a small part of a large triangle. So a photometry is bounded by steps: cones
/// about its lobes, at the edge of each of which it has fallen to a quarter, and what is left
/// beyond them,
///
///     I(ω) ≲ M(ω) = c_0 + Σ_k c_k [ω in cone k]
///
/// The triangle is cut to each cone, and directions are drawn with a density p
/// proportional to M within it: nothing where M is 0, and so nothing of a beam with an edge is
/// missed, however narrow it is. Estimates by I / p are unbiased whatever M is: the balance
/// heuristic over the cones. Veach & Guibas (1995), Optimally combining sampling techniques for
/// Monte Carlo rendering.
#pragma once

#include <array>
#include <vector>

#include "solver/base/spherical_triangle.h"
#include "solver/surface/luminaire.h"

namespace sunload {

/// What bounds a photometry, in its own frame: x in plane C 0, y in C 90, z along the axis.
struct IntensitySteps {
  struct Cone {
    Vec3 axis;         ///< unit
    double angle;      ///< from the axis to the edge [rad], at most 60°
    double intensity;  ///< c_k, in the web's unit
  };
  std::vector<Cone> cones;
  double beyond = 0;  ///< c_0
};

/// No cones of a web that is wide: where a quarter of its largest intensity is more than 60° from
/// there. Of several lobes the brightest four have cones.
IntensitySteps steps_of(const IntensityWeb& web);

/// One triangle before one luminaire.
class LuminaireView {
 public:
  /// `steps`: of the luminaire's web. Both need not outlive it.
  LuminaireView(const Luminaire& luminaire, const IntensitySteps& steps,
                const std::array<Vec3, 3>& corners);

  /// Whether no cone's edge crosses the triangle: there is nothing to choose directions by.
  bool is_even() const { return parts_.empty(); }
  /// Whether nothing of the luminaire's light can meet the triangle.
  bool is_dark() const { return parts_.empty() && whole_ <= 0; }

  struct Direction {
    Vec3 w;          ///< unit, to the triangle but for a rounding
    double density;  ///< [sr-1]
  };
  /// That of the point (u, v) of the unit square; only where the view is not even.
  Direction sample(double u, double v) const;

 private:
  struct Part;
  void add_part(Vec3 axis, double angle, double intensity);
  void weigh();
  /// Points of the triangle by area, or directions within it where it is large.
  Vec3 sample_triangle_seen(double u, double v) const;
  double density_of_triangle_seen(Vec3 w) const;
  double density(Vec3 w, const Part* own) const;

  /// The triangle in one cone.
  struct Part {
    Vec3 axis{};
    double least_cosine = 0;  ///< to the axis
    double weight = 0;        ///< c_k times the solid angle, then its share of all
    double size = 0;          ///< of what lies in both: solid angle, or area in the plane
    /// The triangle in a pyramid about the cone, in the plane across the axis at distance 1, as a
    /// fan; empty where the triangle holds all of the cone. Of large ones directions are drawn, of
    /// small ones, whose directions would lose digits, points; those outside of the cone again.
    std::vector<Vec3> polygon = {};
    std::vector<SphericalTriangle> fan = {};
    std::vector<double> sizes = {};  ///< of the fan's triangles
    double size_of_fan = 0;
    bool by_solid_angle = false;

    bool contains(Vec3 w) const;
    double density(Vec3 w) const;
    Vec3 sample(double u, double v) const;
    Vec3 sample_cone(double u, double v) const;
    Vec3 sample_fan(double u, double v) const;
  };

  std::array<Vec3, 3> corners_;  ///< relative to the luminaire
  SphericalTriangle seen_;
  double whole_ = 0;  ///< Σ c of what holds all of the triangle; then its weight's share
  std::vector<Part> parts_;
  std::vector<double> weights_;  ///< of `whole_` and the parts, for a choice
};

}  // namespace sunload
