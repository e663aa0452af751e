// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// A series as CSV: one row per interval, columns of groups of patches or of sensors.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>

#include "geo/base/check.h"
#include "geo/time/time.h"
#include "io/base/light_quantity.h"
#include "io/base/text.h"
#include "io/export/format.h"
#include "io/result/patch_groups.h"
#include "io/result/schema.h"
#include "io/result/shown_quantity.h"

namespace sunload {
namespace {

constexpr std::string_view sensor_prefix = "sensor_";

/// Columns of light: their heads, and their values in an interval.
struct SeriesColumns {
  std::vector<std::string> heads;
  std::function<std::vector<double>(std::size_t interval)> values;
};

/// Columns of one number per interval: sun and sky first.
std::vector<std::string> time_columns(const ResultReader& result) {
  std::vector<std::string> names;
  for (const auto& variable : result_schema(result.quantity()))
    if (variable.dims == "time" && variable.part != ResultPart::coordinate &&
        result.has(std::string(variable.name)))
      names.emplace_back(variable.name);
  return names;
}

/// Names of a dataset that were asked for; none where no name of their kind was.
template <class Chosen>
std::vector<std::string> names_asked_for(const ResultReader& result, const NamedParts& parts,
                                         const std::vector<std::string>& patterns,
                                         const char* dataset, const Chosen& chosen) {
  std::vector<std::string> asked;
  if (patterns.empty()) return asked;
  const auto names = result.strings(dataset);
  for (const auto k : chosen(result, parts)) asked.push_back(names[k]);
  return asked;
}

/// Groups that have a column: all, those of a kind (`--of`), or those that are named.
std::vector<std::size_t> chosen_groups(const ResultReader& result, const ExportRules& rules,
                                       const PatchGroups& groups) {
  const auto& parts = rules.parts;
  const auto facades = names_asked_for(result, parts, parts.facades, "facade_name", chosen_facades);
  const auto objects = names_asked_for(result, parts, parts.objects, "object_name", chosen_objects);
  std::vector<std::string> selections;
  if (!parts.selections.empty())
    for (const auto k : chosen_selections(result, parts))
      selections.push_back(selection_names(result)[k]);
  const auto is_one_of = [](const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  std::vector<std::size_t> chosen;
  for (std::size_t g = 0; g < groups.groups().size(); ++g) {
    const auto& group = groups.groups()[g];
    const bool is_of_kind = rules.of.empty() || group.kind == rules.of;
    const bool is_named = !parts.choose_patches() ||
                          (group.kind == "facade" && is_one_of(facades, group.name)) ||
                          (group.kind == "object" && is_one_of(objects, group.name)) ||
                          (group.kind == "selection" && is_one_of(selections, group.name));
    if (is_of_kind && is_named) chosen.push_back(g);
  }
  return chosen;
}

/// Means of a series [time, patch] over groups of patches, of one interval after the other.
class GroupSeries {
 public:
  GroupSeries(const ResultReader& result, const PatchGroups& groups, std::string dataset)
      : result_(result), groups_(groups), of_patches_(std::move(dataset)) {
    if (of_patches_ != dataset_name("irradiance", result.quantity()) || !result.has(of_facades()))
      return;
    const auto names = result.strings("facade_name");
    // Groups are in the order of the file; facades without patches are none.
    std::size_t facade = 0;
    for (std::size_t g = 0; g < groups.groups().size(); ++g) {
      if (groups.groups()[g].kind != "facade") continue;
      while (names.at(facade) != groups.groups()[g].name) ++facade;
      stored_.push_back({g, facade++});
    }
  }
  /// Facades as the file has them, where it does: of patches whose values were not yet rounded
  /// (`output.significant_bits`).
  std::vector<double> means(std::size_t interval) const {
    auto all = groups_.means(result_.row(of_patches_, interval).data());
    if (stored_.empty()) return all;
    const auto of_facades_now = result_.row(of_facades(), interval);
    for (const auto& [group, facade] : stored_) all[group] = of_facades_now.at(facade);
    return all;
  }

 private:
  struct StoredFacade {
    std::size_t group, facade;
  };
  std::string of_facades() const { return dataset_name("facade_irradiance", result_.quantity()); }

  const ResultReader& result_;
  const PatchGroups& groups_;
  std::string of_patches_;
  std::vector<StoredFacade> stored_;
};

std::vector<double> values_of(const std::vector<std::size_t>& chosen,
                              const std::vector<double>& all) {
  std::vector<double> values(chosen.size());
  std::transform(chosen.begin(), chosen.end(), values.begin(),
                 [&](std::size_t i) { return all.at(i); });
  return values;
}

SeriesColumns columns_of_groups(const ResultReader& result, const ExportRules& rules,
                                const std::string& dataset) {
  const auto groups = std::make_shared<const PatchGroups>(result);
  const auto chosen = chosen_groups(result, rules, *groups);
  SeriesColumns columns;
  for (const auto g : chosen) {
    const auto& group = groups->groups()[g];
    columns.heads.push_back(column_name(result, dataset) + " " +
                            (group.kind == "whole" ? "whole" : group.kind + " " + group.name));
  }
  columns.values = [groups, chosen, series = GroupSeries(result, *groups, dataset)](std::size_t k) {
    return values_of(chosen, series.means(k));
  };
  return columns;
}

SeriesColumns columns_of_sensors(const ResultReader& result, const ExportRules& rules,
                                 const std::string& dataset) {
  const auto chosen = chosen_sensors(result, rules.parts);
  SeriesColumns columns;
  for (const auto s : chosen)
    columns.heads.push_back(fmt::format("{} sensor {}", column_name(result, dataset), s));
  columns.values = [&result, chosen, dataset](std::size_t k) {
    return values_of(chosen, result.row(dataset, k));
  };
  return columns;
}

bool is_of_sensors(const ExportRules& rules) {
  return rules.of == "sensor" || (rules.of.empty() && !rules.parts.sensors.empty());
}

/// What can be asked for: series of patches whose means over groups mean something, or what sensors
/// have over time, without the beginning of their names.
std::vector<std::string> series_of_groups(const ResultReader& result) {
  auto names = patch_datasets(result, PatchDatasets::series);
  std::erase_if(names, [](const std::string& name) { return name.ends_with("_se"); });
  return names;
}
std::vector<std::string> series_of_sensors(const ResultReader& result) {
  std::vector<std::string> names;
  for (const auto& variable : result_schema(result.quantity()))
    if (variable.dims == "time,sensor" && result.has(std::string(variable.name)))
      names.emplace_back(variable.name.substr(sensor_prefix.size()));
  return names;
}

std::string dataset_of(const std::string& quantity, bool of_sensors) {
  return (of_sensors ? std::string(sensor_prefix) : "") + quantity;
}

[[noreturn]] void refuse_quantity(const ResultReader& result, const std::string& quantity,
                                  bool of_sensors, const std::vector<std::string>& known) {
  const std::string what = of_sensors ? "sensors" : "groups of patches";
  if (of_sensors && !result.has("sensor_position"))
    throw InputError({result.path()}, "no series " + quantity + " of " + what,
                     "the study has no sensors",
                     "write the section sensors, or export --of facade, object or selection");
  const bool is_there = result.has(dataset_of(quantity, of_sensors));
  const std::string why = !of_sensors && quantity.ends_with("_se")
                              ? "a mean of standard errors is none of a mean"
                          : is_there ? "totals have no intervals"
                                     : "none is stored";
  throw InputError({result.path()}, "no series " + quantity + " of " + what, why,
                   known.empty() ? "run the study with output.series: [total]"
                                 : fmt::format("write series, or one of {}; output.series of the "
                                               "study stores others",
                                               fmt::join(known, ", ")));
}

/// The dataset of the quantity asked for; none where the result has no light over time. Throws
/// InputError for a quantity that it does not have.
std::optional<std::string> wanted_series(const ResultReader& result, const ExportRules& rules) {
  const bool of_sensors = is_of_sensors(rules);
  const bool is_of_all = rules.quantity == "series";
  const std::string quantity =
      is_of_all ? dataset_name("irradiance", result.quantity()) : rules.quantity;
  const auto known = of_sensors ? series_of_sensors(result) : series_of_groups(result);
  if (std::find(known.begin(), known.end(), quantity) != known.end())
    return dataset_of(quantity, of_sensors);
  if (is_of_all && !of_sensors) return {};
  refuse_quantity(result, quantity, of_sensors, known);
}

/// Names of what has no column would be given in vain.
void expect_own_names(const ExportRules& rules) {
  const auto refuse = [&](const char* kind, const std::vector<std::string>& names) {
    if (!rules.of.empty() && rules.of != kind && !names.empty())
      throw InputError({}, fmt::format("--{} {} with --of {}", kind, names.front(), rules.of),
                       "the columns are of one kind", fmt::format("write --of {}", kind));
  };
  refuse("facade", rules.parts.facades);
  refuse("object", rules.parts.objects);
  refuse("selection", rules.parts.selections);
  refuse("sensor", rules.parts.sensors);
  if (rules.of.empty() && rules.parts.choose_patches() && !rules.parts.sensors.empty())
    throw InputError({}, "sensors beside facades, objects or selections",
                     "a table has columns of one kind", "write two tables");
}

void expect_fit_for_series(const ExportRules& rules) {
  if (!rules.time.empty())
    throw InputError({}, "--quantity " + rules.quantity + " has all intervals",
                     "--time chooses one", "leave out --time");
  if (rules.of == "patch")
    throw InputError({}, "--quantity series of patches",
                     "its columns are means over surfaces, objects and facades, or sensors",
                     "write --of facade, object or sensor, or read the result file itself");
  if (rules.of == "orientation")
    throw InputError({}, "--quantity " + rules.quantity + " of orientations",
                     "its columns are means over surfaces, objects and facades, or sensors",
                     "write --of facade; without --quantity their table tells azimuths");
  expect_own_names(rules);
}

}  // namespace

void export_series_csv(const ResultReader& result, const ExportRules& rules, std::ostream& out) {
  expect_fit_for_series(rules);
  const auto dataset = wanted_series(result, rules);
  SeriesColumns light;
  if (dataset)
    light = is_of_sensors(rules) ? columns_of_sensors(result, rules, *dataset)
                                 : columns_of_groups(result, rules, *dataset);
  std::vector<std::vector<double>> of_time;
  out << "begin_utc,end_utc,sun_utc";
  for (const auto& name : time_columns(result)) {
    out << "," << column_name(result, name);
    of_time.push_back(result.doubles(name));
  }
  for (const auto& head : light.heads) out << "," << csv_text(head);
  out << "\n";
  const auto time = result.doubles("time"), bounds = result.doubles("time_bounds");
  const auto shares = result.chosen_shares();
  for (std::size_t k = 0; k < time.size(); ++k) {
    if (shares[k] == 0) continue;
    out << iso_utc(bounds[2 * k]) << "," << iso_utc(bounds[2 * k + 1]) << "," << iso_utc(time[k]);
    for (const auto& column : of_time) out << "," << csv_number(column[k]);
    if (light.values)
      for (const double value : light.values(k)) out << "," << csv_number(value);
    out << "\n";
  }
}

}  // namespace sunload
