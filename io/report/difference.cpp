// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/report/difference.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sunload {
namespace {

// Loads may be stored as float: below its spacing a difference is rounding.
constexpr double rounding_share = std::numeric_limits<float>::epsilon();

/// Two-sided p-value of a true difference at the rim of what does not matter, which is the largest
/// of all that do not (Hodges & Lehmann 1954, Testing the approximate validity of statistical
/// hypotheses); without a rim that of no difference. For differences beyond it. A rim that is a
/// share of the base has the base's noise.
double p_beyond(const ComparisonRow& row, double least_percent, const TwoSamples& samples) {
  const auto p = [&](double beyond, double scale) {
    const DifferenceError error = samples.error(scale);
    return student_t_two_sided_p(beyond / error.se, error.degrees_of_freedom);
  };
  const double difference = std::abs(row.difference_kwh_m2);
  const double of_base = std::abs(*row.base_kwh_m2) * least_percent / 100;
  const double mesh = std::isnan(row.mesh_error_kwh_m2) ? 0 : row.mesh_error_kwh_m2;
  const double rim = std::max(of_base, mesh);
  if (rim == 0) return p(difference, 1);
  const double share = mesh > of_base ? 0 : least_percent / 100;
  const double near = row.difference_kwh_m2 > 0 ? 1 + share : 1 - share;
  return (p(difference - rim, near) + p(difference + rim, 2 - near)) / 2;
}

}  // namespace

double least_difference(double base_load, double variant_load, double least_percent) {
  const double rounding = rounding_share * std::max(std::abs(base_load), std::abs(variant_load));
  return std::max(rounding, std::abs(base_load) * least_percent / 100);
}

DifferenceError TwoSamples::error(double scale) const {
  std::vector<double> scaled = base;
  for (double& value : scaled) value *= scale;
  return errors == Comparison::Errors::paired ? paired_error(scaled, variant)
                                              : welch_error(scaled, variant);
}

void tell_difference(ComparisonRow& row, const std::optional<TwoSamples>& samples,
                     double least_percent) {
  const double base = *row.base_kwh_m2, variant = *row.variant_kwh_m2;
  row.difference_kwh_m2 = variant - base;
  row.difference_percent = base == 0 ? not_known : row.difference_kwh_m2 / base * 100;
  row.se_kwh_m2 = row.degrees_of_freedom = row.p_value = row.p_corrected = not_known;
  if (!samples) return;
  const DifferenceError error = samples->error();
  row.se_kwh_m2 = error.se;
  row.degrees_of_freedom = error.degrees_of_freedom;
  const double difference = std::abs(row.difference_kwh_m2);
  const bool may_be_none = difference <= least_difference(base, variant, least_percent) ||
                           difference <= row.mesh_error_kwh_m2;
  row.p_value = may_be_none ? 1 : p_beyond(row, least_percent, *samples);
}

ComparisonRow row_without_difference(const std::string& kind, const std::string& name) {
  ComparisonRow row;
  row.kind = kind;
  row.name = name;
  row.area_m2 = row.unmatched_area_m2 = not_known;
  row.difference_kwh_m2 = row.difference_percent = not_known;
  row.se_kwh_m2 = row.degrees_of_freedom = row.p_value = row.p_corrected = not_known;
  row.mesh_error_kwh_m2 = not_known;
  return row;
}

}  // namespace sunload
