// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A part of the period that a user asks to see, in the words of the command line.
#pragma once

#include <string>
#include <vector>

#include "geo/time/period_parts.h"

namespace sunload {

/// Empty words choose nothing; what is chosen must hold all at once. Civil time of the site.
struct PeriodChoice {
  std::string month{};   ///< `6` of every year, or `2026-06`
  std::string season{};  ///< spring, summer, autumn, winter
  std::string day{};     ///< `2026-06-21`
  std::string hours{};   ///< `8-12`: from 8:00 to 12:00; `22-4` over midnight
  std::string from{};    ///< a time as in a study; a date is its midnight
  std::string to{};      ///< likewise, exclusive

  bool any() const;
  /// "month 6, hours 8-12"
  std::string words() const;
};

/// Days of these intervals: "2026-06-21, 2026-12-21", "2026-06-01 … 2026-08-31",
/// "12 days of 2026-01-21 … 2026-12-21".
std::string days_in_words(const std::vector<TimeSpan>& intervals, const TimeZone& zone);

}  // namespace sunload
