// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Light that is reflected after the last bounce that is followed: an estimate.
///
/// With d_b = E^(b) - E^(b-1), the light that bounce b brings, all of the light is E^(n) + Σ_{b>n}
/// d_b. After some bounces the rest has nearly the same shape whatever shone first, that of the
/// largest eigenvectors of G rho. Between walls that face each other eigenvalues come in pairs, λ
/// and -λ: light on one wall is on the other after the next bounce, and d_n alone tells one wall
/// only. Two bounces tell both: for λ and for -λ all that follow add up to λ² / (1 - λ²) (d_n +
/// d_(n-1)). So the rest of each patch is a multiple t of its last two bounces, the one that it has
/// under a uniform sky, for which the iteration goes on once and for all,
///
///     E^(∞) - E^(n) ≈ t (d_n + d_(n-1)) ,   t = Σ_{b>n} d_b / (d_n + d_(n-1)) of the uniform sky;
///
/// after one bounce t d_n. A single ratio for all patches (Aitken 1926, by the power that they
/// reflect) misses a fifth of this light in a courtyard, where t misses less than a tenth. Ratios
/// from each patch's own light are worse than no estimate, since single patches are far from their
/// limit after few bounces.
#pragma once

#include <span>
#include <vector>

#include "solver/gather/jacobi.h"

namespace sunload {

/// Number of bounces, at most `bounces`, after which less than `unshot` of the light of a uniform
/// sky remains unfollowed, and less than a hundred times that share of nearly every patch's own
/// light. Decided once per variant.
int bounces_needed(const Hierarchy& mesh, const LineSet& lines, const PatchOptics& optics,
                   int bounces, double unshot);

/// t of every patch after so many bounces; empty after none. The uniform sky shines on what sees
/// it; where anything emits, all patches receive as much again. Cost: some gathers of one column
/// over `lines`.
std::vector<float> light_beyond(const Hierarchy& mesh, const LineSet& lines,
                                const PatchOptics& optics, int bounces);

/// Irradiance of a block by light that bounces do not follow, [N][block] W m-2, ≥ 0.
Columns unfollowed(const Reflected& reflected, std::span<const float> beyond);
/// The same for one realization, [N] J m-2.
std::vector<double> unfollowed(const ReflectedExposure& reflected, std::span<const float> beyond);

}  // namespace sunload
