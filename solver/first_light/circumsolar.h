// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The bright part of a clear sky about the sun, sampled on its own.
///
/// A clear sky holds up to a third of its light within some degrees of the sun, where few of a
/// patch's lines end, and the same few for all suns that stand there. So this part, L_circ, is
/// sampled per patch like the sun itself. Suns of a block share their samples: directions are drawn
/// in proportion to S·q, S the mixture of their L_circ (CircumsolarMixture), q ≈ cosθ
/// (CircumsolarView):
///
///     E_circ = T/n Σ_samples V (L_circ/S) cosθ / q ,   T = ∫ S q dω
///
/// V is the share that passes crowns and screens. Every term is ≥ 0, and 0 where nothing is seen;
/// where all is seen there is next to no error of a sun alone, since cosθ / q is 1 but for the
/// curvature of a cell. Light that mirrors send is left to the lines alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/first_light/circumsolar_sky.h"
#include "solver/first_light/direct_sun.h"

namespace sunload {

/// Adds the irradiance by L_circ of the block to `into`, for each sun no less surely than with as
/// many samples of its own as the sun gets. Returns the rays cast.
std::uint64_t circumsolar_light(const RayCaster& caster, const SunSampler& sampler,
                                std::span<const IntervalLight> block,
                                const std::vector<CircumsolarSky>& skies, const RaySink& into);

}  // namespace sunload
