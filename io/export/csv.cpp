// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>

#include "geo/base/check.h"
#include "geo/mesh/mesh.h"
#include "geo/time/time.h"
#include "io/base/light_quantity.h"
#include "io/base/text.h"
#include "io/export/format.h"
#include "io/result/group_table.h"
#include "io/result/patch_groups.h"
#include "io/result/patches_csv.h"
#include "io/result/schema.h"

namespace sunload {
namespace {

void write_quantity(const ResultReader& result, const ExportRules& rules, std::ostream& out) {
  const auto shown = export_quantity(result, rules);
  const ResultPatches patches(result);
  const auto facades = result.strings("facade_name");
  const auto facade = result.integers("patch_facade"), surface = result.integers("patch_surface"),
             side = result.integers("patch_side");
  out << "index,object,facade,surface,side,area_m2," << column_name(shown)
      << (shown.is_series ? ",time_utc\n" : "\n");
  const std::string when =
      shown.is_series ? "," + iso_utc(result.doubles("time").at(shown.interval)) : "";
  for (const std::size_t i : chosen_patches(result, rules.parts))
    out << fmt::format(
        "{},{},{},{},{},{},{}{}\n", i,
        csv_text(patches.object_names.at(static_cast<std::size_t>(patches.object[i]))),
        facade[i] < 0 ? "" : csv_text(facades.at(static_cast<std::size_t>(facade[i]))),
        surface_names.at(static_cast<std::size_t>(surface[i])), side[i],
        csv_number(patches.area[i]), csv_number(shown.values[i]), when);
}

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

/// Means over groups of patches, of one interval after the other.
class GroupSeries {
 public:
  GroupSeries(const ResultReader& result, const PatchGroups& groups)
      : result_(result),
        groups_(groups),
        of_patches_(dataset_name("irradiance", result.quantity())),
        of_facades_(dataset_name("facade_irradiance", result.quantity())) {
    if (!result.has(of_facades_)) return;
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
    const auto of_facades = result_.row(of_facades_, interval);
    for (const auto& [group, facade] : stored_) all[group] = of_facades.at(facade);
    return all;
  }

 private:
  struct StoredFacade {
    std::size_t group, facade;
  };
  const ResultReader& result_;
  const PatchGroups& groups_;
  std::string of_patches_, of_facades_;
  std::vector<StoredFacade> stored_;
};

/// Sun, sky, ledger, and the means of the irradiance over the whole, surfaces, objects and facades,
/// of the intervals that the chosen part of the period has a share in.
void write_series(const ResultReader& result, const ExportRules& rules, std::ostream& out) {
  if (!rules.time.empty())
    throw InputError({}, "--quantity series has all intervals", "--time chooses one",
                     "leave out --time");
  const std::string dataset = dataset_name("irradiance", result.quantity());
  const bool has_light = result.has(dataset);
  if (rules.of == "patch" || rules.of == "sensor" || !rules.parts.sensors.empty())
    throw InputError({}, "--quantity series of patches or sensors",
                     "its columns are means over surfaces, objects and facades",
                     "write --of facade or object, or read the result file itself");
  const PatchGroups groups(result);
  const auto chosen = chosen_groups(result, rules, groups);
  const GroupSeries series(result, groups);
  std::vector<std::vector<double>> columns;
  out << "begin_utc,end_utc,sun_utc";
  for (const auto& name : time_columns(result)) {
    out << "," << column_name(result, name);
    columns.push_back(result.doubles(name));
  }
  if (has_light)
    for (const auto g : chosen) {
      const auto& group = groups.groups()[g];
      out << ","
          << csv_text(column_name(result, dataset) + " " +
                      (group.kind == "whole" ? "whole" : group.kind + " " + group.name));
    }
  out << "\n";
  const auto time = result.doubles("time"), bounds = result.doubles("time_bounds");
  const auto shares = result.chosen_shares();
  for (std::size_t k = 0; k < time.size(); ++k) {
    if (shares[k] == 0) continue;
    out << iso_utc(bounds[2 * k]) << "," << iso_utc(bounds[2 * k + 1]) << "," << iso_utc(time[k]);
    for (const auto& column : columns) out << "," << csv_number(column[k]);
    if (has_light) {
      const auto means = series.means(k);
      for (const auto g : chosen) out << "," << csv_number(means[g]);
    }
    out << "\n";
  }
}

/// What `--of` names but for patches.
std::optional<TableOf> table_of(const std::string& word) {
  if (word.empty() || word == "patch") return {};
  if (word == "facade") return TableOf::facades;
  if (word == "object") return TableOf::objects;
  if (word == "selection") return TableOf::selections;
  if (word == "sensor") return TableOf::sensors;
  throw InputError({}, "--of " + word, "no such table",
                   "write patch, facade, object, selection or sensor");
}

void expect_parts_of_patches(const ExportRules& rules) {
  if (!rules.parts.sensors.empty())
    throw InputError({}, "--sensor in a table of patches", "sensors are no patches",
                     "add --of sensor");
}

}  // namespace

void export_csv(const ResultReader& result, const ExportRules& rules, const ExportTarget& target) {
  const auto of = table_of(rules.of);
  if (rules.quantity == "series") return write_series(result, rules, target.stream);
  if (of && (!rules.quantity.empty() || !rules.time.empty()))
    throw InputError({}, "--of " + rules.of + " with --quantity or --time",
                     "its columns are the totals",
                     "leave them out, or write --quantity series for means at every instant");
  if (of) {
    target.stream << group_table_csv(group_table(result, *of, rules.parts));
    return;
  }
  expect_parts_of_patches(rules);
  if (rules.quantity.empty() && rules.time.empty())
    target.stream << patches_csv(result, rules.parts);
  else
    write_quantity(result, rules, target.stream);
}

}  // namespace sunload
