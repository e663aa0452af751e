// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Refinement by the light load of the whole period, before anything is tallied.
///
/// The default oracle asks how far the light load on leaves of constant light is from the true one:
///
///     error² = Σ_leaves ∫ (H - mean H)² dA / Σ A      (root mean square over the area)
///
/// and splits the leaves that add most to it (Dörfler 1996: in every pass those that together make
/// up half of it) until it is `light_tolerance` of the mean light load, or nothing that could still
/// be split is left. It sees power and shadow edges, and takes the noise of its own look out of the
/// estimate. The historic one splits every element that sees a sun while cosθ·A/π is too large, or
/// an emitter while the disc estimate of the form factor from there is.
#pragma once

#include <cstddef>

#include "solver/base/watch.h"
#include "solver/mesh/hierarchy.h"
#include "solver/mesh/mesh_pilot.h"
#include "solver/mesh/oracle.h"

namespace sunload {

/// How refinement ended; errors are the pilot's estimates, 0 where it was not asked: where no patch
/// is large enough to be split, and where a sample of a large mesh was fine.
struct RefineReport {
  std::size_t patches_before = 0, patches = 0;
  double error_before = 0, error = 0;  ///< of the light load, share of its mean
  bool is_exhausted = false;           ///< stopped at `min_area_m2` above the tolerance
};

/// Splits by `max_edge_m`, refines, freezes. Throws InputError beyond `max_patches`, Interrupted.
/// Cost: some 16 rays per element, sun and pilot direction, for about twice the final leaves;
/// none where `min_area_m2` lets no patch be split.
Hierarchy refined_mesh(const Scene& scene, const RayCaster& caster, const SplitRules& split,
                       const RefineRules& rules, const PeriodLight& light, Watch& watch,
                       RefineReport* report = nullptr);

}  // namespace sunload
