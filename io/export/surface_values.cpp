// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/export/surface_values.h"

#include <algorithm>
#include <cmath>

#include "io/base/light_quantity.h"
#include "io/export/format.h"
#include "io/result/schema.h"

namespace sunload {
namespace {

/// Over the patches that have a value: measures may be of some surfaces alone.
double weighted_mean(const double* values, const std::vector<double>& area,
                     const std::vector<std::size_t>& patches) {
  double sum = 0, whole = 0;
  for (const auto p : patches) {
    if (std::isnan(values[p])) continue;
    sum += values[p] * area[p];
    whole += area[p];
  }
  return whole > 0 ? sum / whole : std::nan("");
}

/// Of comparisons the patches that both results have alone: the means of their columns are of one
/// place, whose difference is that of the means.
std::vector<double> compared_area(const ResultReader& result) {
  auto area = result.doubles("patch_area");
  if (!result.is_comparison()) return area;
  const auto difference = result.doubles(difference_dataset(result.compared()));
  for (std::size_t p = 0; p < area.size(); ++p)
    if (std::isnan(difference[p])) area[p] = 0;
  return area;
}

}  // namespace

SurfaceValues::SurfaceValues(const ResultReader& result, const ExportRules& rules)
    : area_(compared_area(result)) {
  const auto name = [&](const std::string& dataset) {
    return "sunload_" + column_name(result, dataset);
  };
  if (!rules.quantity.empty()) {
    auto shown = export_quantity(result, rules);
    columns_.push_back({"sunload_" + column_name(shown), Kind::mean, std::move(shown.values)});
    return;
  }
  const std::string largest = dataset_name("irradiance_max", result.quantity());
  for (const auto& dataset : patch_datasets(result, PatchDatasets::totals)) {
    // Errors of patches hang together: those of a set's mean do not follow from them.
    const bool is_of_realizations = dataset == "light_load_se";
    if (dataset == "patch_area" || (dataset.ends_with("_se") && !is_of_realizations)) continue;
    Column column{name(dataset), dataset == largest ? Kind::largest : Kind::mean, {}};
    if (is_of_realizations) {
      if (!result.has("light_load_realization")) continue;
      column.kind = Kind::error_of_mean;
      column.values = result.doubles("light_load_realization");
    } else {
      column.values = result.doubles(dataset);
    }
    columns_.push_back(std::move(column));
  }
}

std::vector<std::string> SurfaceValues::names() const {
  std::vector<std::string> names;
  for (const auto& column : columns_) names.push_back(column.name);
  names.emplace_back("sunload_area_m2");
  return names;
}

SurfaceValues::Named SurfaceValues::of(const std::vector<std::size_t>& patches) const {
  Named named;
  for (const auto& column : columns_)
    if (const double number = value(column, patches); std::isfinite(number))
      named.emplace_back(column.name, number);
  double area = 0;
  for (const auto p : patches) area += area_[p];
  named.emplace_back("sunload_area_m2", area);
  return named;
}

double SurfaceValues::value(const Column& column, const std::vector<std::size_t>& patches) const {
  if (column.kind == Kind::mean) return weighted_mean(column.values.data(), area_, patches);
  if (column.kind == Kind::largest) {
    double largest = column.values[patches.front()];
    for (const auto p : patches) largest = std::max(largest, column.values[p]);
    return largest;
  }
  // Standard error of the mean over R realizations: s / √R.
  const std::size_t count = column.values.size() / area_.size();
  if (count < 2) return std::nan("");
  std::vector<double> means;
  double mean = 0;
  for (std::size_t r = 0; r < count; ++r) {
    means.push_back(weighted_mean(column.values.data() + r * area_.size(), area_, patches));
    mean += means.back() / static_cast<double>(count);
  }
  double squares = 0;
  for (const double m : means) squares += (m - mean) * (m - mean);
  return std::sqrt(squares / static_cast<double>(count * (count - 1)));
}

}  // namespace sunload
