// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Lines of sensors: of points with a normal.
#pragma once

#include "solver/lines/lines.h"

namespace sunload {

/// Traces the lines of the scene's sensors: `lines_per_patch` from each point, cosine distributed
/// about its normal. A point is lifted by the caster's offset along its normal, so that one on a
/// surface sees the hemisphere above it. Points are drawn on all bright surfaces that face it, seen
/// or not.
Lines trace_sensor_lines(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
                         const SkyGrid& grid, const Guide& guide, const LineRules& rules);

}  // namespace sunload
