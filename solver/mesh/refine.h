// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Refinement by the light load of the whole period, before anything is tallied.
///
/// The default oracle asks, of every kind of surface k (walls and windows, roofs, ground, others),
/// how far the light load on leaves of constant light is from the true one:
///
///     error_k² = Σ_leaves w ∫ (H - mean H)² dA / Σ w A
///
/// w is 1 near walls and falls with the distance from there (nearness.h): where people look. It
/// splits the leaves that add most to it (Dörfler 1996: in every pass those that together make up
/// half of it) until it is `light_tolerance` of the mean light load of that kind, or nothing that
/// could still be split is left. By Chebyshev no more than (light_tolerance/x)² of the area then
/// varies by more than x of the mean. Light by mirrors makes small bright images that are little of
/// the mean: of those that exceed the tolerance the same is asked apart, five times as wide and by
/// their own root mean square.
///
/// A look at some hundred points does not find the shadow of a house on a hectare: leaves are no
/// longer than the distance to the nearest wall, or than `near_m` there, to begin with (in
/// proportion to the tolerance).
///
/// It sees power and shadow edges, and takes the noise of its own look out of the estimate. Several
/// scenes of one geometry, each with a light, can be asked at once: the mesh is fine enough for
/// all. The historic oracle splits every element that sees a sun while cosθ·A/π is too large, or an
/// emitter while the disc estimate of the form factor from there is.
#pragma once

#include <cstddef>
#include <span>

#include "solver/base/watch.h"
#include "solver/mesh/hierarchy.h"
#include "solver/mesh/load_sums.h"
#include "solver/mesh/mesh_pilot.h"
#include "solver/mesh/oracle.h"

namespace sunload {

/// How refinement ended; errors are the pilot's estimates, 0 where it was not asked: where no patch
/// is large enough to be split, and where a sample of a large mesh was fine.
struct RefineReport {
  std::size_t patches_before = 0, patches = 0;
  double error_before = 0, error = 0;  ///< of the worst kind's light load, share of its mean
  KindErrors error_of_kind{};          ///< a fifth of that of glints
  std::size_t pilots = 1;
  bool is_exhausted = false;  ///< stopped at `min_area_m2` above the tolerance
};

/// A scene and the light that its pilot has.
struct PilotView {
  const Scene& scene;
  const RayCaster& caster;
  const PeriodLight& light;
};

/// Splits by `max_edge_m`, refines, freezes. The scenes, one at least, differ in their materials
/// alone. Throws InputError beyond `max_patches`, Interrupted.
/// Cost: some 16 rays per element, sun and pilot direction, for about twice the final leaves;
/// none where `min_area_m2` lets no patch be split.
Hierarchy refined_mesh(std::span<const PilotView> views, const SplitRules& split,
                       const RefineRules& rules, Watch& watch, RefineReport* report = nullptr);
/// The same of one scene.
Hierarchy refined_mesh(const Scene& scene, const RayCaster& caster, const SplitRules& split,
                       const RefineRules& rules, const PeriodLight& light, Watch& watch,
                       RefineReport* report = nullptr);

}  // namespace sunload
