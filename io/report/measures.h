// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What measures say, for people, and as JSON; what changes between two results.
#pragma once

#include <string>
#include <vector>

#include "io/result/measure_table.h"

namespace sunload {

/// A table per measure, with its definition, source and parameters.
std::string measure_table_text(const ResultReader& result, const std::vector<MeasureRow>& rows);
/// Study, variant, what the measures are, and one object per row; null where a value is not known.
std::string measure_table_json(const ResultReader& result, const std::vector<MeasureRow>& rows);

/// One line per measure: the whole, and how many facades and sensors reach which level.
std::string measures_line(const ResultReader& result);

/// What a rule says of a group, or of a sensor, in two results.
struct MeasureChange {
  std::string measure, units;  ///< units as the files state them
  std::string kind, name;      ///< kind: object, facade, selection, sensor
  double base_reached = 0, variant_reached = 0;
  std::string base_level, variant_level;
  /// Whether the variant reaches a better level than the base, or a worse one.
  enum class To { same, better, worse } to = To::same;  ///< by levels
};
/// Of all that have a verdict in both results by the same rule and limits, be it in other years,
/// and that `parts` chooses (all where it chooses nothing).
std::vector<MeasureChange> measure_changes(const ResultReader& base, const ResultReader& variant,
                                           const NamedParts& parts);
/// Which of them are of other years, or are not compared as rules or limits differ.
std::vector<std::string> notes_on_verdicts(const ResultReader& base, const ResultReader& variant);
/// Per measure how many of each kind pass before and after, and what reaches another level.
std::string measure_changes_text(const std::vector<MeasureChange>& changes);

}  // namespace sunload
