// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The light of rays in one band: rays are traced once, for the mean of the bands, and their light
/// is scaled for each.
#pragma once

#include <span>

#include "solver/gather/band_light.h"
#include "solver/gather/time_sums.h"
#include "solver/traced/light_iteration.h"

namespace sunload {

/// Adds the time integrals of a band: `suns` have its light, relative to the traced one `factors`.
void add_exposures(const BlockRays& rays, const BandFactors& factors,
                   std::span<const IntervalLight> suns, TimeSums& sums);

/// The light of a band: all of it is proportional to the sun, or to the circumsolar sky. Columns
/// of realizations come along for errors per instant alone.
BlockRays in_band(const BlockRays& rays, const BandFactors& factors, Errors errors);

}  // namespace sunload
