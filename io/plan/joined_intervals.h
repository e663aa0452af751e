// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Short intervals that are solved together: a year of minutes as one of hours.
///
/// Where only sums over time are asked for (`output.series_step`, or no series), light need not be
/// followed minute by minute. What comes from the sky and by reflection is linear in its sources:
/// that of all intervals of a step follows from the mean of their skies. What comes straight from
/// the sun is told for suns that stand at most two minutes of its way apart, each with the direct
/// light of its own intervals; light that mirrors send on, for one of every twenty minutes.
#pragma once

#include <string>

#include "io/plan/light_series.h"
#include "io/study/study.h"

namespace sunload {

/// Intervals that lie within one step of the site's clock, an hour at most and a divisor of
/// `output.series_step`, become one, with these as its parts; where the study asks for it, or
/// leaves it open and it pays: for two thousand intervals with light and four of them in a step.
/// The others stay. Appends a note where any were joined.
void join_short_intervals(const Study& study, LightSeries& series);

/// All that this follows from beside the series, in words.
std::string joining_words(const Study& study);

}  // namespace sunload
