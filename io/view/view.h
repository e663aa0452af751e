// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// `sunload view`: results as one page of HTML that needs neither network nor server.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/result/period_choice.h"

namespace sunload {

/// What of the results the page holds.
struct ViewRules {
  /// Every how manyth interval the page holds; none: the least that keeps the
  /// page below about 60 MB.
  std::optional<std::size_t> step;
  std::optional<std::size_t> band;  ///< of results in bands; none: their mean
  PeriodChoice period;              ///< that totals are of
};

/// Writes the page for one result, or for two that are shown side by side or as
/// a difference. Tells on the standard error where intervals are left out. Throws InputError
/// for a result without patches, MachineError where the page was not built into
/// this program or cannot be written.
void view_html(const std::vector<std::string>& results, const ViewRules& rules,
               const std::string& path);

}  // namespace sunload
