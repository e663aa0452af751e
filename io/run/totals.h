// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What batches of a variant add up to.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "geo/base/units.h"
#include "io/batch/file.h"

namespace sunload {

inline constexpr double kwh_per_joule = 1 / joules_per_kwh;

/// Sums and maxima of all batches, in batch order.
class Totals {
 public:
  /// Adds the arrays of a batch, but for those of parts of the period.
  void add(const BatchReader& batch);
  void add(const std::string& name, MergeRule rule, std::vector<double> values);
  /// Where arrays are those of bands, adds their means under the names without band.
  void add_means();
  bool has(const std::string& name) const { return arrays_.contains(name); }
  const std::vector<double>& operator[](const std::string& name) const { return arrays_.at(name); }

 private:
  std::map<std::string, std::vector<double>> arrays_;
};

/// Standard error over the rows of a [realization, n] array.
std::vector<double> errors_of(const std::vector<double>& rows, std::size_t n);

}  // namespace sunload
