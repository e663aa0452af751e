// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Hours of the period in which a series is above a threshold.
#pragma once

#include "io/measure/rule.h"

namespace sunload {

/// `light`: total, direct, sky, mirror, …; the threshold is above_w_m2, or above_lx.
std::unique_ptr<Measure> start_light_hours(const std::string& light,
                                           const MeasureParameters& parameters,
                                           const MeasuredScene& scene);

}  // namespace sunload
