// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The rules that studies may ask for.
#pragma once

#include <string>
#include <vector>

#include "io/measure/rule.h"

namespace sunload {

/// In the order of docs/measures.md.
const std::vector<MeasureRule>& measure_rules();
/// Null for a word that is none of theirs.
const MeasureRule* find_measure_rule(const std::string& word);

/// A number that some rule has a key for.
struct MeasureKey {
  std::string key;
  double low = 0, high = 0;
};
/// All of them, whatever the rule: a key means the same everywhere.
const std::vector<MeasureKey>& measure_keys();
/// Keys with words, and all words that a rule knows for it.
const std::vector<RuleWords>& measure_word_keys();

/// Part of the light whose series a measure watches: total, direct, …; empty: none.
std::string watched_light(const MeasureRule& rule, const MeasureParameters& parameters);

/// Levels of a measure; none: it has no verdict.
std::vector<MeasureLevel> levels_of(const MeasureRule& rule, const MeasureParameters& parameters);

/// The rule's words, and what the study measures by other limits, or another day, than the rule's
/// own: "hours of possible sun on 21 March; 2 h pass; here with least_h 3, date 2026-04-21".
std::string definition_of(const MeasureRule& rule, const MeasureParameters& parameters);

/// The page of all rules: what docs/measures.md has between its marks.
std::string measure_rules_markdown();

}  // namespace sunload
