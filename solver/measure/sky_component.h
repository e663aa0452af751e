// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The light of an overcast sky at points of a scene, as a share of that on open level ground.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "solver/measure/sun_spans.h"

namespace sunload {

/// Directions of the sky that are looked at, of which a wall faces half. They are the same for all
/// points. In courts of any shape and direction, on walls and on the ground, the share is right
/// within 0.004 (root mean square 0.001).
inline constexpr std::uint32_t sky_directions = 4096;

/// For every point ∫ L cosθ dω over the sky that it sees, divided by the same of an open level
/// surface, with L of the CIE standard overcast sky, 1 + 2 sin(elevation) (Moon & Spencer 1942).
/// `is_open`: whether a direction (unit, scene axes) is free of far hills.
std::vector<double> overcast_sky_components(std::span<const MeasuredPoint> points,
                                            const RayCaster& caster,
                                            const std::function<bool(Vec3)>& is_open);

}  // namespace sunload
