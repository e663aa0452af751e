// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Sensors of two results side by side.
#pragma once

#include <vector>

#include "io/report/compare.h"
#include "io/result/reader.h"

namespace sunload {

/// Per sensor of the base, whether the same number stands in the same place of the variant and
/// looks the same way (to a millimetre, and a thousandth of the normal). None where a result has
/// none.
std::vector<char> sensors_in_both(const ResultReader& base, const ResultReader& variant);

/// A row for every sensor, without an area: of both results where both have it (`sensors_in_both`),
/// else one of each. None where a result does not have what `comparison` is of for sensors. Takes
/// dataset, errors and least percent of `comparison`.
std::vector<ComparisonRow> compared_sensors(const ResultReader& base, const ResultReader& variant,
                                            const Comparison& comparison);

}  // namespace sunload
