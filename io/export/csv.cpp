// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "geo/base/check.h"
#include "geo/mesh/mesh.h"
#include "geo/time/time.h"
#include "io/base/light_quantity.h"
#include "io/base/text.h"
#include "io/export/format.h"
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
  out << "index,object,facade,surface,side,area_m2," << column_name(result, shown.dataset)
      << (shown.is_series ? ",time_utc\n" : "\n");
  const std::string when =
      shown.is_series ? "," + iso_utc(result.doubles("time").at(shown.interval)) : "";
  for (std::size_t i = 0; i < patches.area.size(); ++i)
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

/// Sun, sky, ledger, and the means of the irradiance over the whole, surfaces, objects and facades.
void write_series(const ResultReader& result, const ExportRules& rules, std::ostream& out) {
  if (!rules.time.empty())
    throw InputError({}, "--quantity series has all intervals", "--time chooses one",
                     "leave out --time");
  const std::string dataset = dataset_name("irradiance", result.quantity());
  const bool has_light = result.has(dataset);
  const PatchGroups groups(result);
  std::vector<std::vector<double>> columns;
  out << "begin_utc,end_utc,sun_utc";
  for (const auto& name : time_columns(result)) {
    out << "," << column_name(result, name);
    columns.push_back(result.doubles(name));
  }
  if (has_light)
    for (const auto& group : groups.groups())
      out << ","
          << csv_text(column_name(result, dataset) + " " +
                      (group.kind == "whole" ? "whole" : group.kind + " " + group.name));
  out << "\n";
  const auto time = result.doubles("time"), bounds = result.doubles("time_bounds");
  for (std::size_t k = 0; k < time.size(); ++k) {
    out << iso_utc(bounds[2 * k]) << "," << iso_utc(bounds[2 * k + 1]) << "," << iso_utc(time[k]);
    for (const auto& column : columns) out << "," << csv_number(column[k]);
    if (has_light)
      for (const double mean : groups.means(result.row(dataset, k).data()))
        out << "," << csv_number(mean);
    out << "\n";
  }
}

}  // namespace

void export_csv(const ResultReader& result, const ExportRules& rules, const ExportTarget& target) {
  if (rules.quantity.empty() && rules.time.empty())
    target.stream << patches_csv(result);
  else if (rules.quantity == "series")
    write_series(result, rules, target.stream);
  else
    write_quantity(result, rules, target.stream);
}

}  // namespace sunload
