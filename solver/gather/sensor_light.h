// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Light on sensors: lines and shadow rays of points, on the light of a solved scene.
///
/// A sensor is a row of lines like a patch, but all of its lines start at one point
/// and none of its light goes on. With the patches' radiosity B (seen_radiosity),
///
///     E = E_direct + E_sky + E_mirror + E_lamps + Σ_links w B_target + w_ground B_ground
///
/// follows the light exactly as far as the patches' own reflected part does. E_mirror is the sun's
/// by mirrors and gloss (light_iteration) and the sky's by the lines.
#pragma once

#include "solver/gather/block_light.h"
#include "solver/lines/lines.h"

namespace sunload {

/// Light of a block on the rows of `lines`, whose targets are elements of that radiosity.
BlockLight sensor_light(const LineSet& lines, const PatchOptics& optics,
                        const BlockSources& sources, RayColumns rays,
                        const std::vector<double>& parallel, const Columns& radiosity);

/// Its reflected part alone: the two last terms.
Columns reflected_on_sensors(const LineSet& lines, const BlockSources& sources,
                             const Columns& radiosity);

}  // namespace sunload
