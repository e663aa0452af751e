// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What measures say, for people, and as JSON.
#pragma once

#include <string>
#include <vector>

#include "io/result/measure_table.h"

namespace sunload {

/// A table per measure, with its definition, source and parameters.
std::string measure_table_text(const ResultReader& result, const std::vector<MeasureRow>& rows);
/// Study, variant, what the measures are, and one object per row; null where a value is not known.
std::string measure_table_json(const ResultReader& result, const std::vector<MeasureRow>& rows);

/// What a measure was given, as a study writes it, but for its name, rule and day.
std::string parameters_in_words(const MeasureWords& words);

/// Of a measure of one name in two results: by the same rule and limits, on the same day, or in
/// another year.
enum class MeasureLikeness { same, of_other_years, different };
MeasureLikeness likeness_of(const MeasureWords& base, const MeasureWords& variant);

/// One line per measure: the whole, and how many facades and sensors reach which level.
std::string measures_line(const ResultReader& result);

}  // namespace sunload
