// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What a set of patches receives, as named numbers: for the surfaces and objects of city models.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "io/export/export.h"
#include "io/result/reader.h"

namespace sunload {

/// "sunload_light_load_kwh_m2": dataset and unit. Values are area-weighted means over the patches
/// of a set; `irradiance_max` is the largest of them, the standard error of the light load that of
/// its mean over the set, from the realizations.
class SurfaceValues {
 public:
  /// The quantity asked for, or every total of the result.
  SurfaceValues(const ResultReader& result, const ExportRules& rules);

  std::vector<std::string> names() const;
  using Named = std::vector<std::pair<std::string, double>>;
  /// Of at least one patch; numbers that are not known are left out. The last is the area [m²].
  Named of(const std::vector<std::size_t>& patches) const;

 private:
  enum class Kind { mean, largest, error_of_mean };
  struct Column {
    std::string name;
    Kind kind = Kind::mean;
    /// Of patches; error_of_mean: of realizations, one after the other.
    std::vector<double> values;
  };
  double value(const Column& column, const std::vector<std::size_t>& patches) const;

  std::vector<double> area_;
  std::vector<Column> columns_;
};

}  // namespace sunload
