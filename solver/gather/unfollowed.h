// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Light that is reflected after the last bounce that is followed: an estimate.
///
/// With d_b = E^(b) - E^(b-1), what bounce b brings, all of the light is E^(n) + Σ_{b>n} d_b. After
/// some bounces what is left has nearly the same shape whatever shone first, that of the largest
/// eigenvectors of G rho. Between walls that face each other these come in pairs, λ and -λ: what
/// one wall has now the other has next, and d_n alone tells the one only. Two bounces tell both:
/// the sum of all that follow is λ² / (1 - λ²) (d_n + d_(n-1)) of either. So each patch receives as
/// many times its last two as it does under a uniform sky, for which the iteration goes on once and
/// for all,
///
///     E^(∞) - E^(n) ≈ t (d_n + d_(n-1)) ,   t = Σ_{b>n} d_b / (d_n + d_(n-1)) of the uniform sky;
///
/// after one bounce t d_n. One ratio for all patches (Aitken 1926, by the power that they reflect)
/// leaves a fifth of this light in a courtyard, where t leaves less than a tenth; ratios patch by
/// patch are worse than none, since single patches are far from their limit after few bounces.
#pragma once

#include <span>
#include <vector>

#include "solver/gather/jacobi.h"

namespace sunload {

/// Bounces after which less than `unshot` of the light of a uniform sky would remain unfollowed,
/// and of nearly every patch's own light less than a hundred times that, at most `bounces`: decided
/// once per variant.
int bounces_needed(const Hierarchy& mesh, const LineSet& lines, const PatchOptics& optics,
                   int bounces, double unshot);

/// t of every patch after so many bounces; empty after none. Where nothing else is seen all
/// surfaces shine. Cost: some gathers of one column over `lines`.
std::vector<float> light_beyond(const Hierarchy& mesh, const LineSet& lines,
                                const PatchOptics& optics, int bounces);

/// Irradiance of a block by light that bounces do not follow, [N][block] W m-2, ≥ 0.
Columns unfollowed(const Reflected& reflected, std::span<const float> beyond);
/// The same for one realization, [N] J m-2.
std::vector<double> unfollowed(const ReflectedExposure& reflected, std::span<const float> beyond);

}  // namespace sunload
