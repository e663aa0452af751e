// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Intervals of a result: which one is meant, and how to say it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "geo/time/time.h"
#include "io/result/reader.h"

namespace sunload {

/// The civil time zone of the result (UTC where it names none).
TimeZone result_zone(const ResultReader& result);

/// Whether suns are given by their positions: times are invented then, to tell rows apart.
bool has_no_dates(const ResultReader& result);

/// What rows of series are means over where these are steps (`output.series_step`): "60 min",
/// "day", "month"; empty: intervals.
std::string series_step(const ResultReader& result);
/// Whether a row is a day or a month, for which no one sun stands.
bool has_long_steps(const ResultReader& result);

/// Interval with the largest global horizontal irradiance; where there is none
/// at all, with the highest sun. 0 for a result without intervals.
std::size_t brightest_interval(const ResultReader& result);

/// The interval whose bounds hold a time as written in a study
/// (`2026-06-21T12:00`: civil time of the site, unless an offset or Z is
/// written). Throws InputError where the period does not cover it.
std::size_t interval_at(const ResultReader& result, const std::string& time);

/// The sun's instant and the interval it stands for, in civil time and in UTC:
/// "2026-06-21 12:30 +02:00 for 12:00 … 13:00 (2026-06-21T10:30:00Z for 10:00 … 11:00)".
std::string interval_in_words(const ResultReader& result, std::size_t interval);

/// What a row of series shows: "sun of …" the interval in words, or of steps "mean of begin … end"
/// in civil time; of suns without dates their number and position.
std::string row_in_words(const ResultReader& result, std::size_t row);

/// The days that there are, of the part that is chosen: "2026-06-21, 2026-12-21", or begin and end
/// where there is no gap.
std::string period_in_words(const ResultReader& result);

/// Whether the intervals of the parts that are chosen are the same, with the same shares.
bool have_same_times(const ResultReader& base, const ResultReader& variant);
/// What to tell of two results that have not; empty: they have.
std::string different_times_in_words(const ResultReader& base, const ResultReader& variant);

/// Lengths of the intervals [s].
std::vector<double> interval_lengths(const ResultReader& result);

}  // namespace sunload
