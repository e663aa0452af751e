// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The sky dome in patches of daylighting practice: Tregenza's 145 and Reinhart's finer ones.
///
/// Rows of equal height about the zenith cap; patches count clockwise from north, the first
/// one centred on it, rows from the horizon up.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
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

/// Skies that are given by the radiance of patches, constant over each, as cells of a grid.
class PatchSkies {
 public:
  PatchSkies(Subdivision subdivision, const SkyGrid& grid);
  std::size_t patch_count() const { return patches_.size(); }
  /// Horizontal irradiance ∫ L cosθ dω [W m-2] of radiances [W m-2 sr-1], one per patch, in the
  /// order of `sky_patches`.
  double horizontal_irradiance(std::span<const double> of_patches) const;
  /// Radiance of the cells [W m-2 sr-1], of that horizontal irradiance to rounding: cells that lie
  /// in several patches have each by its share.
  std::vector<double> on_grid(std::span<const double> of_patches) const;

 private:
  struct Share {
    std::uint32_t patch = 0;
    float of_cell = 0;
  };
  std::vector<SkyPatch> patches_;
  std::vector<double> projected_;        ///< of the grid's cells
  std::vector<std::uint32_t> first_{0};  ///< per cell, into `shares_`
  std::vector<Share> shares_;
};

}  // namespace sunload
