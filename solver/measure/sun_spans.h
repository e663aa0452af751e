// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// When points of a scene have sun on a day: spans with exact begin and end.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "geo/base/vec.h"
#include "solver/surface/ray_caster.h"

namespace sunload {

/// A point that is measured: on a surface, or a sensor; it looks along the unit normal.
struct MeasuredPoint {
  Vec3 position;  ///< m, relative to the scene's origin; rays start `offset_m` off it
  Vec3 normal;
};

/// A stretch of sun, times in s.
struct SunSpan {
  double begin = 0, end = 0;
  double length_s() const { return end - begin; }
};

/// The sun's way over a day.
struct SunCourse {
  std::vector<SunSpan> counted;           ///< in order: when the sun is high enough to count
  std::function<Vec3(double)> direction;  ///< to the sun at a time [s], unit, in scene axes
};

/// What the sun's direction must keep from a point's surface.
struct SunAngles {
  double to_surface_deg = 0;  ///< least angle between the sun and the surface, from its front
  /// The same between their projections on the horizontal plane; nothing to surfaces that lie flat.
  double in_plan_deg = 0;
};

/// Steps on which the sun is looked for: it moves its own diameter of half a degree meanwhile.
/// A shadow, or a gap between two, that passes within one of them may be missed.
inline constexpr double sun_course_step_s = 120;
/// To which begin and end of spans are found.
inline constexpr double sun_change_within_s = 0.5;

/// For every point the spans in which the sun's centre counts, meets the front at the angles asked
/// for, and is not hidden. All surfaces of the caster hide it.
std::vector<std::vector<SunSpan>> sunlit_spans(std::span<const MeasuredPoint> points,
                                               const RayCaster& caster, const SunCourse& course,
                                               const SunAngles& angles);

/// Sum of the spans that are at least so long [s].
double total_s(std::span<const SunSpan> spans, double least_s);
/// The longest one, the first of equal ones; of length 0 where there is none.
SunSpan longest(std::span<const SunSpan> spans);

}  // namespace sunload
