// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Which surfaces are bright by the light of emitters: a first look, by which no number of a
/// result is made, only where points are drawn (solver/lines/bright_view.h).
#pragma once

#include "solver/gather/jacobi.h"
#include "solver/lines/lines.h"

namespace sunload {

/// Emitters alone, each by its exitance, whether they are seen or not. Cost: a scan of the patches.
Guide emitting_surfaces(const Scene& scene, const Hierarchy& hierarchy, const PatchOptics& optics);

/// Emitters and what they light, after `bounces` diffuse reflections. None where nothing emits:
/// the sun and the sky light large surfaces, which lines do not miss.
///
/// Few lines find where the light goes, and where it is faint they find it badly: hence twice,
/// the second time with points on what the first has found bright. Cost: a quarter of what
/// trace_lines() casts by these rules, as much for what sees what, and an eighth for the share of
/// the estimate that the lines keep for themselves. Throws Interrupted.
Guide lit_surfaces(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
                   const SkyGrid& grid, const PatchOptics& optics, const LineRules& rules,
                   int bounces);

}  // namespace sunload
