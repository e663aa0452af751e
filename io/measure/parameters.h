// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What a study asks of one measure.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "geo/base/check.h"
#include "geo/time/time.h"

namespace sunload {

/// Patches that are measured: patterns of names (`*`, `?`), a kind of surface and the name of a
/// selection; empty: any.
struct MeasureOf {
  std::string object, facade, surface, selection;
};

/// One measure as the study writes it, with what it leaves out filled in.
struct MeasureParameters {
  std::string name;                          ///< of its datasets: measure_NAME
  std::string rule;                          ///< word in `measure_rules`
  std::map<std::string, double> numbers;     ///< by key, defaults of the rule filled in
  std::map<std::string, std::string> words;  ///< the same
  std::optional<CivilTime> date;             ///< absent: the rule's own day, or it needs none
  MeasureOf of;
  Where where;

  double number(const std::string& key) const { return numbers.at(key); }
};

}  // namespace sunload
