// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/result/shown_quantity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geo/base/check.h"
#include "io/base/colour_map.h"
#include "io/base/statistics.h"
#include "io/base/text.h"
#include "io/result/measure_table.h"
#include "io/result/radiance.h"
#include "io/result/schema.h"
#include "io/result/time.h"

namespace sunload {
namespace {

/// All that can be shown of a result.
std::vector<std::string> shown_names(const ResultReader& result) {
  auto names = patch_datasets(result, PatchDatasets::totals);
  for (auto& name : patch_datasets(result, PatchDatasets::series)) names.push_back(std::move(name));
  if (!result.is_derived()) names.push_back(radiance_name(result.quantity()));
  return names;
}

bool is_one_of(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Of all that is shown it alone is no dataset.
bool is_radiance(const ResultReader& result, const std::string& quantity) {
  return !result.is_derived() && quantity == radiance_name(result.quantity());
}

ShownQuantity shown_radiance(const ResultReader& result, const std::string& time) {
  ShownQuantity s;
  s.dataset = radiance_name(result.quantity());
  s.name = s.dataset + " of diffuse light alone";
  s.stored_units = radiance_units(result.quantity());
  s.units = display_units(s.stored_units);
  s.is_derived = true;
  s.is_series = !time.empty();
  s.interval = s.is_series ? interval_at(result, time) : brightest_interval(result);
  s.values = s.is_series ? radiance_at(result, s.interval) : mean_radiance(result);
  s.when = s.is_series ? row_in_words(result, s.interval) : "mean of " + period_in_words(result);
  return s;
}

/// Of the shapes alone, whatever the sun does.
bool is_of_shapes(const std::string& dataset) {
  return dataset == "patch_area" || dataset == "sky_view_factor";
}

std::string name_in_words(const std::string& dataset) {
  constexpr std::string_view error = "_se";
  return dataset.ends_with(error)
             ? "standard error of " + spaced(dataset.substr(0, dataset.size() - error.size()))
             : spaced(dataset);
}

}  // namespace

std::string usual_quantity(const ResultReader& result) {
  if (result.is_place_map()) return std::string(given_dataset);
  return result.is_comparison() ? difference_dataset(result.compared()) : "light_load";
}

std::string leave_out_or_name_a_series(const ResultReader& result) {
  const auto series = patch_datasets(result, PatchDatasets::series);
  return series.empty() ? "leave it out: no series is stored (output.series of the study)"
                        : "leave it out, or name a series: --quantity " + series.front();
}

std::vector<double> ShownQuantity::sizes() const {
  auto sizes = values;
  if (is_difference)
    for (double& value : sizes) value = std::abs(value);
  return sizes;
}

std::vector<std::string> patch_datasets(const ResultReader& result, PatchDatasets which) {
  const std::string_view dims = which == PatchDatasets::totals ? "patch" : "time,patch";
  const auto patches = result.shape("patch_area").front();
  std::vector<std::string> names;
  const auto schema = result.is_comparison()
                          ? comparison_schema(result.quantity(), result.compared())
                      : result.is_place_map() ? place_map_schema(result.quantity())
                                              : result_schema(result.quantity());
  for (const auto& variable : schema) {
    const std::string name(variable.name);
    if (variable.dims == dims && !variable.units.empty() && !is_of_mean(name) && result.has(name) &&
        result.shape(name).back() == patches)
      names.push_back(name);
  }
  if (which == PatchDatasets::totals)
    for (const auto& measure : measure_names(result))
      names.push_back(std::string(measure_prefix) + measure);
  return names;
}

ShownQuantity shown_quantity(const ResultReader& result, const std::string& dataset,
                             const std::string& time) {
  if (is_radiance(result, dataset)) return shown_radiance(result, time);
  ShownQuantity s;
  s.is_series = is_one_of(patch_datasets(result, PatchDatasets::series), dataset);
  if (!s.is_series && !is_one_of(patch_datasets(result, PatchDatasets::totals), dataset)) {
    const bool is_meant =
        find_result_variable(dataset) != nullptr || dataset.starts_with(measure_prefix);
    throw unknown_quantity(
        result, dataset, shown_names(result),
        is_meant && result.chosen().any() ? "it is not known of " + result.chosen().words() : "");
  }
  s.dataset = dataset;
  s.name = name_in_words(dataset);
  s.stored_units = result.units(dataset);
  s.units = display_units(s.stored_units);
  s.is_difference = result.is_comparison() && dataset == difference_dataset(result.compared());
  if (!result.is_derived())
    s.interval = time.empty() ? brightest_interval(result) : interval_at(result, time);
  s.values = s.is_series ? result.row(dataset, s.interval) : result.doubles(dataset);
  s.when = s.is_series ? row_in_words(result, s.interval) : period_in_words(result);
  if (is_of_shapes(dataset)) s.when.clear();
  if (dataset.starts_with(measure_prefix))
    if (const auto day = result.text_attribute(dataset, "when"); !day.empty()) s.when = day;
  return s;
}

InputError unknown_quantity(const ResultReader& result, const std::string& quantity,
                            const std::vector<std::string>& known, const std::string& why) {
  return {{result.path()},
          "no quantity " + quantity + " per patch",
          why,
          fmt::format("choose one of {}", fmt::join(known, ", "))};
}

double scale_end(const std::optional<double>& largest, const std::vector<double>& values,
                 const std::vector<double>& area) {
  if (largest) {
    if (!(*largest > 0) || !std::isfinite(*largest))
      throw InputError({}, fmt::format("--max {}", *largest), "must be above 0");
    return *largest;
  }
  const double quantile = weighted_quantile(values, area, scale_share);
  return quantile > 0 ? rounded_up(quantile) : 1;
}

}  // namespace sunload
