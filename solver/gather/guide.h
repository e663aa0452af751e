// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Which surfaces are bright by the light of emitters: a first estimate. No number of a result is
/// made from it; it decides only where points are drawn (solver/lines/bright_view.h).
#pragma once

#include "solver/gather/jacobi.h"
#include "solver/lines/lines.h"

namespace sunload {

/// Emitters alone, each by its exitance, whether they are seen or not. Cost: a scan of the patches.
Guide emitting_surfaces(const Scene& scene, const Hierarchy& hierarchy, const PatchOptics& optics);

/// Emitters and what they light, after `bounces` diffuse reflections. None where nothing emits:
/// the sun and the sky light large surfaces, which lines do not miss.
///
/// Few lines find faint light badly. So the estimate is made twice, the second time with points on
/// the surfaces that the first one found bright. Cost, relative to the rays of trace_lines() by
/// these rules: a quarter for the lines, as much for which clusters are seen, and an eighth for the
/// share of the estimate that the lines keep for themselves. Throws Interrupted.
Guide lit_surfaces(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
                   const SkyGrid& grid, const PatchOptics& optics, const LineRules& rules,
                   int bounces);

}  // namespace sunload
