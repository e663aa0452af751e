// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Rules of planning in a study to begin with.
#pragma once

#include <string>
#include <vector>

#include "io/init/findings.h"

namespace sunload {

/// Words of the rules that `init` writes, as studies have them.
std::vector<std::string> offered_rules();
/// The rules of these words, in their order and each once; `_`, `-`, blanks and capitals make no
/// difference (EN17037). Throws InputError for one that is none.
std::vector<std::string> rules_of_words(const std::vector<std::string>& words);

/// Throws InputError where what was found cannot serve a rule: dates without a place, a year
/// without weather.
void expect_measurable(const std::vector<std::string>& rules, const Findings& found);
/// Whether one of them counts over the year.
bool is_year_needed(const std::vector<std::string>& rules);
/// Series that they watch beside the total, each with a comma before it.
std::string watched_series(const std::vector<std::string>& rules);
/// The section `measures`; empty without rules.
std::string measure_text(const std::vector<std::string>& rules, const Findings& found);

}  // namespace sunload
