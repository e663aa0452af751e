// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Sensors of two results side by side.
#pragma once

#include <vector>

#include "io/report/compare.h"
#include "io/result/reader.h"

namespace sunload {

/// A row for every sensor, without an area: of both results where the same number stands in the
/// same place and looks the same way (to a millimetre, and a thousandth of the normal), else one of
/// each. None where a result does not have what `comparison` is of for sensors. Takes dataset,
/// errors and least percent of `comparison`.
std::vector<ComparisonRow> compared_sensors(const ResultReader& base, const ResultReader& variant,
                                            const Comparison& comparison);

}  // namespace sunload
