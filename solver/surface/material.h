// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Optical properties of surfaces, and the scene that light is computed in.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geo/mesh/mesh.h"
#include "solver/light/band.h"
#include "solver/surface/luminaire.h"
#include "solver/surface/sensor.h"
#include "solver/surface/smooth.h"

namespace sunload {

/// What a surface does with light.
///
/// A share `diffuse` of panes and metals is a coat (frit, dust, print): that share of the
/// light never meets the glass, whatever its angle; of the rest Fresnel's formulas decide.
/// So diffuse + mirror + transmitted ≤ 1 holds at every angle.
struct Material {
  std::string name;
  double diffuse = 0;        ///< reflectance rho
  double mirror = 0;         ///< reflectance rho_s, the same at every angle; 0 of panes and metals
  double emission_w_m2 = 0;  ///< diffuse exitance M of an emitter
  Smooth smooth = {};        ///< of all but constant shares the three below are 0
  /// Reflectance rho_g of light from the normal (solver/surface/lobe.h).
  double glossy = 0;
  double glossy_exponent = 0;  ///< n of its lobe
  double transmittance = 0;    ///< T: light that passes straight through (crowns, screens)
  /// The share `diffuse` in each band, of which it is the mean; absent: grey. Only of constant
  /// shares without gloss, whose other shares do not depend on it.
  std::optional<BandShares> diffuse_in_band = {};
  bool operator==(const Material&) const = default;
};

/// Where light goes that arrives at some angle, as shares of its power.
struct SmoothShares {
  double mirror = 0;
  double transmitted = 0;  ///< out of the outdoor scene
};
/// Of a material of any kind, at the angle of incidence of that cosine.
SmoothShares smooth_shares(const Material& material, double cos_theta);

/// Diffuse reflectance in a band.
inline double diffuse_in(const Material& m, std::size_t band) {
  return m.diffuse_in_band ? (*m.diffuse_in_band)[band] : m.diffuse;
}
/// Decided by Fresnel's formulas: panes and metals.
inline bool is_fresnel(const Material& m) {
  return std::holds_alternative<Panes>(m.smooth) || std::holds_alternative<Metal>(m.smooth);
}
/// What a smooth surface does with light depends on the angle: panes of either kind, metals.
inline bool is_pane_or_metal(const Material& m) {
  return !std::holds_alternative<ConstantShares>(m.smooth);
}
/// T0 of clear glass, 0 of all else.
inline double normal_transmittance(const Material& m) {
  const auto* glass = std::get_if<ClearGlass>(&m.smooth);
  return glass ? glass->normal_transmittance : 0;
}
/// What it absorbs depends on the angle.
inline bool depends_on_angle(const Material& m) { return is_pane_or_metal(m) || m.glossy > 0; }
/// Reflects by the law of reflection, though clear glass may reflect a share of 0.
inline bool is_mirror(const Material& m) { return m.mirror > 0 || is_pane_or_metal(m); }
/// A line that meets it goes on, or ends in ways that depend on its angle.
inline bool sends_on(const Material& m) { return is_mirror(m) || m.glossy > 0; }

/// Light goes on from it, or through it, in a direction of its own.
inline bool goes_on_straight(const Material& m) { return sends_on(m) || m.transmittance > 0; }

/// A share that is 1 less all others: where these are all of the light, roundings may leave less
/// than nothing.
inline double left_over(double share) { return std::max(0.0, share); }

/// Share of power that an ideal mirror of this material returns at the angle
/// whose cosine is `cos_theta` (of incidence). Constant for plain mirrors.
inline double mirror_reflectance(const Material& material, double cos_theta) {
  return is_fresnel(material) ? smooth_shares(material, cos_theta).mirror : material.mirror;
}

/// The same of a ray that was stopped: rays are stopped by 1 - T of what they meet.
inline double mirror_weight_of_hit(const Material& material, double cos_theta) {
  return mirror_reflectance(material, cos_theta) / (1 - material.transmittance);
}

/// Finite parallel emitters: each triangle sends light along its normal.
struct ParallelSources {
  Mesh mesh;                     ///< vertices and triangles alone, relative to the scene's origin
  std::vector<double> exitance;  ///< per triangle, above 0 [W m-2]
};

/// A prepared mesh with one material per triangle.
struct Scene {
  Mesh mesh;
  std::vector<Material> materials;
  std::vector<MaterialId> material;  ///< per triangle, into `materials`
  ParallelSources parallel_sources = {};
  Luminaires luminaires = {};
  std::vector<Sensor> sensors = {};  ///< receive light without disturbing the rest

  /// Lamps that are no surfaces of it.
  bool any_lamp_beside_surfaces() const {
    return !parallel_sources.exitance.empty() || luminaires.any();
  }
  const Material& material_of(std::size_t triangle) const {
    return materials[material[triangle].index()];
  }
  const Material& material_of(std::int32_t triangle) const {
    return material_of(static_cast<std::size_t>(triangle));
  }
};

/// Shares of a refused or degenerate material are errors of the caller: throws
/// std::logic_error unless sizes agree and every share lies in its range.
void expect_valid(const Scene& scene);

/// Triangles that let light pass, for the ray caster.
struct Screens {
  std::vector<float> transmittance;  ///< per triangle; empty where all are opaque
  std::vector<std::uint64_t> key;    ///< stable address: object and number within it
};
/// Those of a scene, as RayCaster takes them. What light goes through, has no patches and lies on
/// another surface stops none.
Screens screens(const Scene& scene);

}  // namespace sunload
