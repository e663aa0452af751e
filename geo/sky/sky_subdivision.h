// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The sky dome in patches of daylighting practice: Tregenza's 145 and Reinhart's finer ones.
///
/// Rows of equal height about the zenith cap; patches count clockwise from north, the first
/// one centred on it, rows from the horizon up.
#pragma once

#include <cstddef>
#include <vector>

#include "geo/sky/sky.h"

namespace sunload {

/// Tregenza (1987), Lighting Research & Technology 19: 145 patches, rows of 12°. Reinhart
/// & Walkenhorst (2001): each of them in 2 × 2 (577) or 4 × 4 (2305), the cap undivided.
enum class Subdivision { tregenza, reinhart_mf2, reinhart_mf4 };

/// Part of the dome between two elevations and two azimuths [degrees].
struct SkyPatch {
  double elevation_low_deg = 0, elevation_high_deg = 0;
  double azimuth_low_deg = 0, azimuth_high_deg = 0;  ///< low may be negative (about north)
  Vec3 direction;                                    ///< of its middle, x east, y north
  double solid_angle = 0;                            ///< [sr]
  double projected = 0;                              ///< ∫ cosθ dω [sr]
};

std::vector<SkyPatch> sky_patches(Subdivision subdivision);

/// Mean radiance of each patch [W m-2 sr-1], ∫ L dω / ω, of a sky in the frame x east,
/// y north.
std::vector<double> mean_radiance(const std::vector<SkyPatch>& patches, const Sky& sky);

}  // namespace sunload
