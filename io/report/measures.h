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

/// Facades and sensors that reach another level in the variant; empty where the two have no
/// measure in common.
std::string measure_changes_text(const ResultReader& base, const ResultReader& variant,
                                 const NamedParts& parts);

}  // namespace sunload
