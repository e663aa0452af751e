// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Light of a batch integrated over time, by which every realization is solved once more.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "solver/first_light/ray_light.h"
#include "solver/gather/block_light.h"
#include "solver/light/tally.h"

namespace sunload {

/// Sources and irradiance by rays, integrated over time [J m-2, or J]; of every realization where
/// each has an estimate of its own.
struct TimeSums {
  TimeSums(std::size_t realizations, std::size_t patches, std::size_t sensors,
           std::size_t sky_cells);
  /// Adds sky, far ground and time of a block. `shares`: the share that counts of each sun's time;
  /// none: all of it.
  void add_sources(const BlockSources& sources, std::span<const double> shares = {});
  /// The same of a block whose sky is not split: circumsolar light is for the caller to take out.
  void add_whole_sources(const BlockSources& sources, std::span<const double> shares = {});

  RaySums on_patches, on_sensors;
  std::vector<double> sky;           ///< [cells] π·radiance·time
  std::vector<double> sky_of_lines;  ///< the same without circumsolar light
  double ground = 0;
  double length_s = 0;          ///< for lamps
  std::vector<Ledger> sent_on;  ///< [R] the sun's light that mirrors sent on
};

/// Sums that a block's light is added to, for so many seconds of each of its suns.
struct TimedSums {
  TimeSums* sums;
  SunSeconds seconds;
};

/// Light that the rows of one realization receive by other ways than its lines.
struct ExposureByRays {
  const std::vector<double>&direct, &by_mirror;  ///< [J m-2]
  const std::vector<double>& circumsolar;        ///< [J m-2]; empty: the lines take the whole sky
  const std::vector<double>& parallel;           ///< of parallel sources [W m-2], or empty
};

/// Time-integrated irradiance of one realization before any diffuse reflection [J m-2].
struct FirstExposure {
  std::vector<double> sky, mirror, lamps;  ///< straight from the sky; by mirrors; of emitters
  std::vector<double> base, ground;        ///< all but the far ground; far ground
};
FirstExposure first_exposure(const LineSet& lines, const PatchOptics& optics, const TimeSums& sums,
                             const ExposureByRays& by_rays);

}  // namespace sunload
