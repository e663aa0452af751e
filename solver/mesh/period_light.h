// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Light of a period in short, for a first look.
#pragma once

#include <array>
#include <vector>

#include "geo/base/vec.h"

namespace sunload {

/// A sun that stands for a part of the period.
struct PeriodSun {
  Vec3 direction;       ///< to the sun, unit
  double exposure = 0;  ///< normal to it [J m-2]
};

/// Suns, sky, far ground and lamps, each integrated over the period.
struct PeriodLight {
  /// Suns that are taken as they are.
  std::vector<PeriodSun> suns;
  /// Two samples of the suns, each standing for all of them, where there are too many.
  std::array<std::vector<PeriodSun>, 2> samples;
  std::vector<double> sky;  ///< per cell of a SkyGrid(): π·radiance·time [J m-2]
  double ground = 0;        ///< exitance of the far ground · time [J m-2]
  double lamp_time_s = 0;   ///< for which emitters of the scene shine
};

}  // namespace sunload
