// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "geo/base/check.h"
#include "geo/mesh/mesh.h"
#include "geo/time/time.h"
#include "io/base/light_quantity.h"
#include "io/base/text.h"
#include "io/export/format.h"
#include "io/result/group_table.h"
#include "io/result/patches_csv.h"

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

/// What `--of` names but for patches.
std::optional<TableOf> table_of(const std::string& word) {
  if (word.empty() || word == "patch") return {};
  if (word == "facade") return TableOf::facades;
  if (word == "object") return TableOf::objects;
  if (word == "orientation") return TableOf::orientations;
  if (word == "selection") return TableOf::selections;
  if (word == "sensor") return TableOf::sensors;
  throw InputError({}, "--of " + word, "no such table",
                   "write patch, facade, object, orientation, selection or sensor");
}

void expect_parts_of_patches(const ExportRules& rules) {
  if (!rules.parts.sensors.empty())
    throw InputError({}, "--sensor in a table of patches", "sensors are no patches",
                     "add --of sensor");
}

}  // namespace

void export_csv(const ResultReader& result, const ExportRules& rules, const ExportTarget& target) {
  const auto of = table_of(rules.of);
  if (rules.quantity == "series" || (of && !rules.quantity.empty()))
    return export_series_csv(result, rules, target.stream);
  if (of && !rules.time.empty())
    throw InputError({}, "--of " + rules.of + " with --time", "its columns are the totals",
                     "leave it out, or write --quantity series for means at every instant");
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
