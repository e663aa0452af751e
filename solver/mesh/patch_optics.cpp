// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/mesh/patch_optics.h"

namespace sunload {

PatchOptics patch_optics(const Scene& scene, const Hierarchy& hierarchy) {
  PatchOptics optics;
  optics.any_emission = scene.any_lamp_beside_surfaces();
  for (const auto& patch : hierarchy.patches()) {
    const Material& m = scene.material_of(patch.triangle);
    optics.diffuse.push_back(static_cast<float>(m.diffuse));
    optics.mirror.push_back(static_cast<float>(mirror_reflectance(m, 1)));
    optics.glossy.push_back(static_cast<float>(m.glossy));
    optics.passed.push_back(static_cast<float>(m.transmittance));
    optics.by_angle.push_back(depends_on_angle(m));
    optics.emission.push_back(static_cast<float>(m.emission_w_m2));
    optics.any_emission = optics.any_emission || m.emission_w_m2 > 0;
    optics.any_mirror = optics.any_mirror || sends_on(m);
    optics.any_glossy = optics.any_glossy || m.glossy > 0;
  }
  return optics;
}

PatchOptics patch_optics(const Scene& scene, const Hierarchy& hierarchy, std::size_t band) {
  PatchOptics optics = patch_optics(scene, hierarchy);
  for (std::size_t i = 0; i < optics.diffuse.size(); ++i) {
    const Material& m = scene.material_of(hierarchy.patches()[i].triangle);
    optics.diffuse[i] = static_cast<float>(diffuse_in(m, band));
  }
  return optics;
}

}  // namespace sunload
