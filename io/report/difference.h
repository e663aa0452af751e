// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The difference that a row of a comparison tells, and how sure it is.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/base/statistics.h"
#include "io/report/compare.h"

namespace sunload {

/// Differences of means that are no larger, either way, are none: `least_percent` of the base, and
/// at least the rounding of what is stored.
double least_difference(double base_load, double variant_load, double least_percent);

/// Realizations of a mean in both results.
struct TwoSamples {
  std::vector<double> base, variant;
  Comparison::Errors errors;  ///< paired or independent

  /// Of variant − scale · base.
  DifferenceError error(double scale = 1) const;
};

/// Of a row that has both values and its mesh error: the difference, and with `samples` its
/// standard error and p-value; without them these are not known.
void tell_difference(ComparisonRow& row, const std::optional<TwoSamples>& samples,
                     double least_percent);

/// A row of which nothing is known but its kind and name.
ComparisonRow row_without_difference(const std::string& kind, const std::string& name);

}  // namespace sunload
