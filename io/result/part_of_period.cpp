// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/result/part_of_period.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "io/result/own_seasons.h"
#include "io/result/reader.h"
#include "io/result/schema.h"
#include "io/result/time.h"
#include "solver/light/tally.h"

namespace sunload {

namespace {

constexpr std::string_view load_word = "light_load", error_end = "_se",
                           realization_end = "_realization";

/// "light_load_se" of months → "light_load_by_month_se".
std::string name_by(const std::string& dataset, const std::string& kind) {
  for (const std::string_view end : {error_end, realization_end})
    if (dataset.ends_with(end))
      return dataset.substr(0, dataset.size() - end.size()) + "_by_" + kind + std::string(end);
  return dataset + "_by_" + kind;
}

std::string without_end(const std::string& name, std::string_view end) {
  return name.substr(0, name.size() - end.size());
}

std::vector<TimeSpan> intervals_of(const ResultReader& result) {
  const auto bounds = result.doubles("time_bounds");
  std::vector<TimeSpan> intervals(bounds.size() / 2);
  for (std::size_t k = 0; k < intervals.size(); ++k)
    intervals[k] = {bounds[2 * k], bounds[2 * k + 1]};
  return intervals;
}

void add(const std::vector<double>& values, std::vector<double>& sum) {
  if (sum.empty()) sum.assign(values.size(), 0);
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += values[i];
}

/// Standard errors of realizations one after the other, of `n` values each.
std::vector<double> standard_errors(const std::vector<double>& realizations, std::size_t n) {
  std::vector<double> errors(n), values(n > 0 ? realizations.size() / n : 0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t r = 0; r < values.size(); ++r) values[r] = realizations[r * n + i];
    errors[i] = mean_error(values).standard_error;
  }
  return errors;
}

/// What to write into the study for such a choice.
std::string asked_totals(const PeriodChoice& choice, const OwnSeasons& own) {
  const int words = !choice.month.empty() + !choice.season.empty() + !choice.day.empty() +
                    !choice.hours.empty() + (!choice.from.empty() || !choice.to.empty());
  std::string series = "output.series: [total]";
  if (words > 1 || own.has(choice.season)) return series;
  const auto totals = [&](const char* kind) {
    return fmt::format("output.totals: [{}] or {}", kind, series);
  };
  if (!choice.month.empty()) return totals("month");
  if (!choice.season.empty()) return totals("season");
  if (!choice.hours.empty()) return totals("hour_of_day");
  return totals("day");
}

}  // namespace

std::vector<std::string> part_labels(const ResultReader& result, const std::string& kind) {
  if (kind != part_kind_names[static_cast<std::size_t>(PartKind::hour_of_day)])
    return result.strings(kind);
  std::vector<std::string> labels;
  for (const auto hour : result.integers(kind)) labels.push_back(std::to_string(hour));
  return labels;
}

PartOfPeriod::PartOfPeriod(const ResultReader& result, const PeriodChoice& choice)
    : result_(result) {
  if (result.is_comparison())
    throw InputError({result.path()},
                     choice.words() + ": a comparison is of the period it was made of", "",
                     "compare the results with --" + choice.words() + " --hdf5 FILE");
  if (result.is_place_map())
    throw InputError({result.path()}, choice.words() + ": the map is of the period it was made of",
                     "", "write it with explain --" + choice.words() + " --map FILE");
  length_s_ = interval_lengths(result);
  if (has_no_dates(result))
    throw InputError({result.path()}, choice.words() + ": its suns have no dates",
                     "they are given by their positions (period.positions)");
  const auto intervals = intervals_of(result);
  const TimeZone zone = result_zone(result);
  const double latitude = result.number_attribute("latitude_deg");
  const OwnSeasons own = own_seasons(result);
  try {
    shares_ = chosen_shares(choice, intervals, zone, latitude, own);
  } catch (const InputError& error) {
    // Of several results one may lack a season.
    throw InputError(result.path() + ": " + error.what());
  }
  is_whole_ = std::all_of(shares_.begin(), shares_.end(), [](double share) { return share == 1; });
  if (is_whole_) return;
  std::vector<TimeSpan> hours;
  for (const TimeSpan& interval : intervals)
    for (const TimeSpan& hour : clock_hours(interval, zone)) hours.push_back(hour);
  const auto shares_of_hours = chosen_shares(choice, hours, zone, latitude, own);
  for (const PartKind kind :
       {PartKind::month, PartKind::season, PartKind::day, PartKind::hour_of_day})
    if (find_parts(kind, hours, shares_of_hours, zone, latitude)) return;
  const std::string step = series_step(result);
  if (!step.empty() && std::any_of(shares_.begin(), shares_.end(),
                                   [](double share) { return share > 0 && share < 1; }))
    throw InputError({result.path()}, choice.words() + " cuts steps of the series",
                     "they are means over steps: " + step,
                     "choose whole steps, or run the study with a shorter output.series_step");
  if (!of_series(std::string(load_word)).empty()) return;
  throw InputError({result.path()}, "has nothing of " + choice.words(),
                   "its stored totals of parts do not make it up, and it has no series",
                   "run the study with " + asked_totals(choice, own));
}

/// Divisions are computed as when the result was written; parts without errors do where there are
/// no others. `hours` are those of the clock that the intervals are made of, each in one part.
bool PartOfPeriod::find_parts(PartKind kind, const std::vector<TimeSpan>& hours,
                              const std::vector<double>& shares_of_hours, const TimeZone& zone,
                              double latitude_deg) {
  const std::string name = part_kind_names[static_cast<std::size_t>(kind)];
  if (!result_.has(name_by(std::string(load_word), name)) || !result_.has(name)) return false;
  const PeriodDivision division = divided(kind, hours, zone, latitude_deg);
  const auto labels = part_labels(result_, name);
  if (labels.size() != division.parts.size()) return false;
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < labels.size(); ++row) {
    const PeriodPart& part = division.parts[row];
    if (part.label != labels[row]) return false;
    const auto is = [&](double share) {
      return [&, share](const PartShare& of) { return shares_of_hours[of.interval] == share; };
    };
    if (std::all_of(part.intervals.begin(), part.intervals.end(), is(1)))
      rows.push_back(row);
    else if (!std::all_of(part.intervals.begin(), part.intervals.end(), is(0)))
      return false;
  }
  const bool has_errors = result_.has(name_by("light_load_realization", name));
  if (!kind_.empty() && !has_errors) return false;
  kind_ = name;
  rows_ = std::move(rows);
  return has_errors;
}

bool PartOfPeriod::tells(const std::string& dataset) const {
  if (is_whole_) return false;
  const ResultVariable* variable = find_result_variable(dataset, result_.quantity());
  if (!variable || variable->part != ResultPart::total) return false;
  return dataset.find("_by_") == std::string::npos && !is_of_scene(dataset);
}

std::string PartOfPeriod::of_parts(const std::string& dataset) const {
  if (kind_.empty()) return {};
  const std::string name = name_by(dataset, kind_);
  return result_.has(name) ? name : std::string();
}

std::string PartOfPeriod::of_series(const std::string& dataset) const {
  if (dataset.ends_with(error_end) || dataset.ends_with(realization_end)) return {};
  std::string name = dataset;
  const std::string series = dataset_name("irradiance", result_.quantity());
  constexpr std::string_view largest_end = "_max";
  if (const auto load = name.find(load_word); load != std::string::npos)
    name.replace(load, load_word.size(), series);
  else if (name.ends_with(largest_end) && !series_step(result_).empty())
    return {};  // means of steps do not tell the largest value of an interval
  else if (name.ends_with(largest_end))
    name = without_end(name, largest_end);
  const ResultVariable* variable = find_result_variable(name, result_.quantity());
  const bool is_there = variable && variable->part == ResultPart::series && result_.has(name);
  return is_there ? name : std::string();
}

bool PartOfPeriod::has(const std::string& dataset) const {
  return !of_parts(dataset).empty() || !of_series(dataset).empty();
}

std::vector<double> PartOfPeriod::values(const std::string& dataset) const {
  if (of_parts(dataset).empty()) return from_series(dataset);
  if (!dataset.ends_with(error_end) || rows_.size() == 1) return sum_of_parts(dataset);
  const std::string stem = without_end(dataset, error_end);
  const auto n = result_.shape(of_parts(dataset)).back();
  return standard_errors(sum_of_parts(stem + std::string(realization_end)), n);
}

std::vector<double> PartOfPeriod::sum_of_parts(const std::string& dataset) const {
  std::vector<double> sum;
  for (const std::size_t row : rows_) add(result_.rows(of_parts(dataset), row, 1), sum);
  return sum;
}

std::vector<double> PartOfPeriod::from_series(const std::string& dataset) const {
  const std::string series = of_series(dataset);
  const bool is_load = dataset.find(load_word) != std::string::npos;
  std::vector<double> values(result_.shape(series).back(), 0);
  constexpr std::size_t rows_at_once = 64;
  for (std::size_t first = 0; first < shares_.size(); first += rows_at_once) {
    const std::size_t count = std::min(rows_at_once, shares_.size() - first);
    const auto begin = shares_.begin() + static_cast<std::ptrdiff_t>(first);
    if (std::all_of(begin, begin + static_cast<std::ptrdiff_t>(count),
                    [](double share) { return share == 0; }))
      continue;
    const auto rows = result_.rows(series, first, count);
    for (std::size_t k = 0; k < count; ++k) {
      const double share = shares_[first + k];
      if (share == 0) continue;
      const double kilo_hours = share * length_s_[first + k] / joules_per_kwh;
      for (std::size_t i = 0; i < values.size(); ++i) {
        const double value = rows[k * values.size() + i];
        values[i] = is_load ? values[i] + value * kilo_hours : std::max(values[i], value);
      }
    }
  }
  return values;
}

}  // namespace sunload
