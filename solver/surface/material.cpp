// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/surface/material.h"

#include <algorithm>

#include "geo/base/check.h"
#include "geo/base/keys.h"
#include "geo/mesh/lying.h"
#include "solver/base/rng.h"
#include "solver/surface/clear_glass.h"
#include "solver/surface/fresnel.h"

namespace sunload {

namespace {

// Reflectances that were given as decimals may exceed 1 by their rounding.
constexpr double rounding = 1e-12;

bool has_valid_shares(const Material& m) {
  const double transmitted = clear_glass_factor * normal_transmittance(m);  // the most
  return m.diffuse >= 0 && m.mirror >= 0 && m.glossy >= 0 && m.transmittance >= 0 &&
         transmitted >= 0 &&
         m.diffuse + m.mirror + m.glossy + m.transmittance + transmitted <= 1 + rounding;
}

bool has_valid_bands(const Material& m) {
  if (!m.diffuse_in_band) return true;
  if (depends_on_angle(m)) return false;
  return std::all_of(m.diffuse_in_band->begin(), m.diffuse_in_band->end(), [&](double diffuse) {
    return diffuse >= 0 && diffuse + m.mirror + m.transmittance <= 1 + rounding;
  });
}

bool is_valid(const ConstantShares& /*any*/) { return true; }
bool is_valid(const Panes& panes) {
  return panes.refractive_index > 1 && panes.thickness_m > 0 && panes.absorption_per_m >= 0 &&
         panes.count >= 1;
}
bool is_valid(const ClearGlass& glass) { return glass.normal_transmittance > 0; }
bool is_valid(const Metal& metal) {
  return metal.refractive_index > 0 && metal.extinction_coefficient > 0;
}

bool has_valid_kind(const Material& m) {
  if (is_fresnel(m) && m.mirror > 0) return false;
  if (is_pane_or_metal(m) && (m.glossy > 0 || m.transmittance > 0)) return false;
  return std::visit([](const auto& smooth) { return is_valid(smooth); }, m.smooth);
}

SmoothShares shares_of(const ConstantShares& /*any*/, const Material& m, double /*cos_theta*/) {
  return {m.mirror, 0};
}

SmoothShares shares_of(const ClearGlass& glass, const Material& m, double cos_theta) {
  return {m.mirror, clear_glass_transmittance(glass.normal_transmittance, cos_theta)};
}

SmoothShares shares_of(const Metal& metal, const Material& m, double cos_theta) {
  const double bare = 1 - m.diffuse;
  return {bare * metal_reflectance(metal.refractive_index, metal.extinction_coefficient, cos_theta),
          0};
}

SmoothShares shares_of(const Panes& panes, const Material& m, double cos_theta) {
  const double bare = 1 - m.diffuse;
  const PaneShares glass = pane_shares(
      {panes.refractive_index, panes.absorption_per_m * panes.thickness_m, panes.count}, cos_theta);
  return {bare * glass.reflected, bare * glass.transmitted};
}

}  // namespace

SmoothShares smooth_shares(const Material& m, double cos_theta) {
  return std::visit([&](const auto& smooth) { return shares_of(smooth, m, cos_theta); }, m.smooth);
}

void expect_valid(const Scene& scene) {
  SUNLOAD_EXPECT(scene.material.size() == scene.mesh.triangle_count(), "one material per triangle");
  for (const auto& m : scene.materials) {
    SUNLOAD_EXPECT(has_valid_shares(m), "reflectances of " + m.name);
    SUNLOAD_EXPECT(has_valid_bands(m), "reflectances in bands of " + m.name);
    SUNLOAD_EXPECT(has_valid_kind(m), "kind of " + m.name);
    SUNLOAD_EXPECT(m.glossy_exponent >= 0, "exponent of " + m.name);
    SUNLOAD_EXPECT(m.emission_w_m2 >= 0, "emission of " + m.name);
  }
  for (const auto id : scene.material)
    SUNLOAD_EXPECT(id.exists() && id.index() < scene.materials.size(), "material of a triangle");
}

namespace {

/// Triangles that let light pass and have no patches, but lie on opaque ones that have: the
/// underside of a crown on a roof. Of crowns on crowns each is crossed.
std::vector<std::uint8_t> undersides(const Scene& scene) {
  const Mesh& mesh = scene.mesh;
  std::vector<std::uint8_t> are_bare(mesh.triangle_count(), 0), are_opaque(are_bare);
  for (std::size_t t = 0; t < are_bare.size(); ++t) {
    const bool is_screen = scene.material_of(t).transmittance > 0;
    (is_screen ? are_bare : are_opaque)[t] = is_screen != mesh.bears_patches(t) ? 1 : 0;
  }
  if (std::find(are_bare.begin(), are_bare.end(), 1) == are_bare.end()) return are_bare;
  return lying_on(mesh, are_bare, are_opaque);
}

}  // namespace

Screens screens(const Scene& scene) {
  Screens screens;
  if (std::none_of(scene.materials.begin(), scene.materials.end(),
                   [](const Material& m) { return m.transmittance > 0; }))
    return screens;
  const Mesh& mesh = scene.mesh;
  const std::vector<std::uint8_t> is_underside = undersides(scene);
  std::vector<std::uint64_t> number_in_object(mesh.object_names.size(), 0);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const auto object = mesh.triangle_object[t].index();
    // Light that an underside stopped would be lost, and no ray could tell it from what it lies on.
    screens.transmittance.push_back(
        is_underside[t] != 0 ? 1 : static_cast<float>(scene.material_of(t).transmittance));
    screens.key.push_back(mixed(text_key(mesh.object_names[object]), number_in_object[object]++));
  }
  return screens;
}

}  // namespace sunload
