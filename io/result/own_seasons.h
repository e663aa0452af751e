// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Seasons that the study of a result has, by names of its own.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/result/period_choice.h"

namespace sunload {

class ResultReader;

/// What `--season` may name before the seasons of the calendar.
struct OwnSeasons {
  std::vector<std::string> names{};   ///< as `flag_word` makes them
  std::vector<std::int32_t> flags{};  ///< of every interval, a bit for each name
  std::vector<TimeSpan> intervals{};  ///< one after the other

  bool has(const std::string& name) const;
  /// Whether the interval of that time lies in the season.
  bool holds(const std::string& name, UnixTime time) const;
};

/// Throws InputError where the file's are not as results have them.
OwnSeasons own_seasons(const ResultReader& result);

/// A name as one of `flag_meanings` (CF 3.5), which have no blanks.
std::string flag_word(std::string name);

/// Share of every interval that is chosen. Throws InputError for words that say nothing, and where
/// nothing of the intervals is chosen. `own`: empty where the study has no seasons.
std::vector<double> chosen_shares(const PeriodChoice& choice,
                                  const std::vector<TimeSpan>& intervals, const TimeZone& zone,
                                  double latitude_deg, const OwnSeasons& own);

}  // namespace sunload
