// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// How long points of a scene have the sun of many intervals.
#pragma once

#include <span>
#include <vector>

#include "solver/measure/sun_spans.h"

namespace sunload {

/// A stretch of sun that one direction stands for.
struct SunStretch {
  Vec3 direction;  ///< unit, to the sun
  double length_s = 0;
};

/// For every point the sum of the stretches whose sun meets its front unhidden [s].
std::vector<double> seen_sun_s(std::span<const MeasuredPoint> points, const RayCaster& caster,
                               std::span<const SunStretch> suns);

}  // namespace sunload
