// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Short intervals that are solved together: a year of minutes as one of hours.
///
/// Where only sums over time are asked for (`output.series_step`, or no series), light need not be
/// followed minute by minute. Light from the sky and by reflection is linear in its sources: for
/// all intervals of a step it follows from the mean of their skies. Straight sunlight is found for
/// suns that stand at most two minutes of the sun's way apart, each with the direct light of its
/// own intervals; sunlight that mirrors send on, for one sun in every twenty minutes.
#pragma once

#include <string>

#include "io/plan/light_series.h"
#include "io/study/study.h"

namespace sunload {

/// Joins intervals that lie within one step of the site's clock (an hour at most, and a divisor of
/// `output.series_step`) and within one of its hours to one, which has them as its parts. Does so
/// where the study asks for it, or leaves the choice open and it pays: from two thousand intervals
/// with light, and four of them in a step, on. Other intervals stay as they are. Appends a note
/// where any were joined.
void join_short_intervals(const Study& study, LightSeries& series);

/// All that joining depends on beside the series, in words.
std::string joining_words(const Study& study);

}  // namespace sunload
