// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The exact sun of one civil day, and rules that count its hours.
#pragma once

#include "io/measure/rule.h"

namespace sunload {

/// When the sun's centre stands at `least_elevation_deg` (apparent) or above, and above the far
/// hills, within the civil day of the site. Changes are found on steps of a minute, then exactly.
SunCourse sun_course(const MeasuredScene& scene, const CivilTime& date, double least_elevation_deg);
SunCourse sun_course(const Site& site, Refraction refraction, Ut1 ut1, const CivilTime& date,
                     double least_elevation_deg);

/// Hours of sun at every point on the day of the parameters: keys least_elevation_deg,
/// least_angle_deg, least_plan_angle_deg, least_span_min where the rule has them, and `count`.
std::unique_ptr<Measure> start_sun_day(const MeasureParameters& parameters,
                                       const MeasuredScene& scene);

}  // namespace sunload
