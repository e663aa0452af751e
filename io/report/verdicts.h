// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What rules say in two results: who passes before and after.
///
/// Groups and sensors are matched as those of a comparison are: of one name, with some area in
/// common that both measure (io/report/common_groups); sensors in the same place. A facade that is
/// another wall of the same number is of one result alone.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/result/measure_table.h"
#include "io/result/named_parts.h"
#include "io/result/reader.h"

namespace sunload {

/// Verdict on one group or sensor; at least one of the two results has it.
struct VerdictPair {
  std::optional<MeasureRow> base, variant;
  double common_m2 = 0;  ///< that both measure; of sensors and of one result alone 0

  const MeasureRow& either() const { return variant ? *variant : *base; }
};

/// All verdicts of the measures that both results have.
struct Verdicts {
  std::vector<std::string> measures;  ///< in the order of the variant
  std::map<std::string, MeasureWords> base_words, variant_words;
  std::vector<VerdictPair> pairs;  ///< per measure; what only the base has comes last
};
/// Reads the tables of both; nothing where one has no measures.
Verdicts verdicts_of_both(const ResultReader& base, const ResultReader& variant);

/// What a rule says of a group, or of a sensor, in two results.
struct MeasureChange {
  std::string measure, units;                    ///< units as the files state them
  std::string kind, name;                        ///< kind: object, facade, selection, sensor
  double base_reached = 0, variant_reached = 0;  ///< NaN: only in the other result
  std::string base_level, variant_level;         ///< empty: only in the other result
  /// Whether the variant reaches a better level than the base, or a worse one.
  enum class To { same, better, worse, only_in_base, only_in_variant } to = To::same;
};
/// By the same rule and limits, be it in other years, of what `parts` chooses (all where it chooses
/// nothing).
std::vector<MeasureChange> measure_changes(const Verdicts& verdicts, const NamedParts& parts);
/// Which are of other years, of other surfaces, or are not compared as rules or limits differ.
std::vector<std::string> notes_on_verdicts(const Verdicts& verdicts);
/// Per measure how many of each kind that both have pass before and after, what reaches another
/// level, and what only one result has.
std::string measure_changes_text(const std::vector<MeasureChange>& changes);

}  // namespace sunload
