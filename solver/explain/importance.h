// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// How much light a place receives, by all ways, for each unit of diffuse light that a patch sends:
/// one adjoint solution.
///
/// Light is E = E_0 + F ρ E, with F the exchange along lines, by mirrors too, and the place has
/// H = wᵀ E. Where patch j sends one unit more, H grows by
///
///     g_j = [ Fᵀ (I − ρ Fᵀ)⁻¹ w ]_j ,    g = Fᵀ w + Fᵀ ρ g ,
///
/// which one transposed Jacobi iteration solves for all patches at once. From it follow, for one
/// place, the derivatives by the reflectance of every patch,
///
///     ∂H/∂ρ_j = g_j E_j ,
///
/// since dE = F dρ E + F ρ dE. E_0 has no diffuse reflection in it and does not depend on ρ; F
/// neither, as lines are drawn without regard to it. Points drawn on bright surfaces
/// (solver/lines/bright_view.h) estimate the same F and are left out.
#pragma once

#include <vector>

#include "solver/explain/place_lines.h"

namespace sunload {

/// [realization][patch], 1.
using Importance = std::vector<std::vector<double>>;

/// For each set of diffuse reflectances of the patches, as many as bands. All reflections are
/// followed but the last millionth of the whole; where surfaces reflect everything, a thousand.
/// `traced` needs no lines of its own. The same bits for any number of threads. Cost: a ray for
/// each line of every patch; memory: 8 bytes for each line of a realization. Throws Interrupted.
std::vector<Importance> importance(const TracedScene& traced, const Place& place,
                                   const std::vector<std::vector<float>>& reflectances);

}  // namespace sunload
