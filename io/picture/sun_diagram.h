// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Stereographic sun-path diagram (`sunload sun --image`).
#pragma once

#include <string>

#include "io/plan/light_series.h"

namespace sunload {

/// Draws the paths of the sun at the site, by apparent elevation:
///
/// - day arcs of the solstices and equinoxes (their civil dates) and of the 21st of the other
///   months, labelled where the sun rises (first half of the year) or sets (second half);
/// - hour lines: the sun at full hours of standard time (no summer time) through the year, blue
///   from December to June, red from June to December;
/// - the sun of every interval of the study as a dot, hollow where hills hide it;
/// - the line of the hills, if the site has one, and the scene's +y axis, if not north.
///
/// The year is that of the study's first interval. Positions without a date have dots only.
/// Throws MachineError where the picture cannot be written.
void draw_sun_diagram(const Study& study, const Site& site, const LightSeries& light,
                      const std::string& path);

}  // namespace sunload
