// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/surface/material.h"

#include <algorithm>

#include "geo/base/check.h"
#include "solver/base/rng.h"
#include "solver/surface/clear_glass.h"
#include "solver/surface/fresnel.h"

namespace sunload {

namespace {

// Reflectances that were given as decimals may exceed 1 by their rounding.
constexpr double rounding = 1e-12;

bool has_valid_shares(const Material& m) {
  const double transmitted = clear_glass_factor * m.normal_transmittance;  // the most
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

bool has_valid_kind(const Material& m) {
  if (m.normal_transmittance > 0 && (is_fresnel(m) || m.glossy > 0 || m.transmittance > 0))
    return false;
  if (!is_fresnel(m)) return m.extinction_coefficient == 0;
  if (m.mirror > 0 || m.glossy > 0 || m.transmittance > 0) return false;
  return m.extinction_coefficient > 0 ||
         (m.refractive_index > 1 && m.thickness_m > 0 && m.absorption_per_m >= 0 && m.panes >= 1);
}

}  // namespace

SmoothShares smooth_shares(const Material& m, double cos_theta) {
  if (!is_fresnel(m))
    return {m.mirror, clear_glass_transmittance(m.normal_transmittance, cos_theta)};
  const double bare = 1 - m.diffuse;
  if (m.extinction_coefficient > 0)
    return {bare * metal_reflectance(m.refractive_index, m.extinction_coefficient, cos_theta), 0};
  const PaneShares glass =
      pane_shares({m.refractive_index, m.absorption_per_m * m.thickness_m, m.panes}, cos_theta);
  return {bare * glass.reflected, bare * glass.transmitted};
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

Screens screens(const Scene& scene) {
  Screens screens;
  if (std::none_of(scene.materials.begin(), scene.materials.end(),
                   [](const Material& m) { return m.transmittance > 0; }))
    return screens;
  const Mesh& mesh = scene.mesh;
  std::vector<std::uint64_t> number_in_object(mesh.object_names.size(), 0);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const auto object = mesh.triangle_object[t].index();
    screens.transmittance.push_back(static_cast<float>(scene.material_of(t).transmittance));
    screens.key.push_back(mixed(text_key(mesh.object_names[object]), number_in_object[object]++));
  }
  return screens;
}

}  // namespace sunload
