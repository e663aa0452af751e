// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/export/format.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <tuple>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "io/base/colour_map.h"
#include "io/base/text.h"

namespace sunload {
namespace {

std::int32_t palette_step(double value, const ExportColours& scale) {
  if (std::isnan(value)) return -1;
  const double share = std::clamp((value - scale.least) / (scale.largest - scale.least), 0.0, 1.0);
  return static_cast<std::int32_t>(std::lround(share * (export_palette_steps - 1)));
}

}  // namespace

Colour export_colour(Palette palette, std::int32_t step) {
  return step < 0 ? no_value_colour(palette)
                  : map_colour(palette, static_cast<double>(step) / (export_palette_steps - 1));
}

ShownQuantity export_quantity(const ResultReader& result, const ExportRules& rules) {
  const bool is_default = rules.quantity.empty();
  auto shown =
      shown_quantity(result, is_default ? usual_quantity(result) : rules.quantity, rules.time);
  if (!rules.time.empty() && !shown.is_series)
    throw InputError({}, "--time " + rules.time,
                     shown.dataset + " is of the whole period" +
                         (is_default ? " and what is exported without --quantity" : ""),
                     leave_out_or_name_a_series(result));
  return shown;
}

Palette export_palette(const ExportRules& rules, const ShownQuantity& shown) {
  if (shown.is_difference && rules.palette && rules.palette != Palette::false_colour)
    throw InputError({}, "--colour of a difference", "it has its own scale, from blue to red",
                     "leave it out");
  return shown.is_difference ? Palette::difference : rules.palette.value_or(Palette::false_colour);
}

ExportColours export_colours(const ResultReader& result, const ExportRules& rules,
                             const ResultPatches& patches) {
  ExportColours colours;
  colours.shown = export_quantity(result, rules);
  colours.largest = scale_end(rules.largest, colours.shown.sizes(), patches.area);
  colours.least = colours.shown.scale_begin(colours.largest);
  colours.palette = export_palette(rules, colours.shown);
  for (const double value : colours.shown.values)
    colours.patch_step.push_back(palette_step(value, colours));
  if (!rules.interpolate) return colours;
  for (const auto& corner : corner_values(patches, colours.shown.values,
                                          rules.crease_angle_deg.value_or(default_crease_deg))) {
    auto& steps = colours.corner_step.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) steps[k] = palette_step(corner[k], colours);
  }
  return colours;
}

std::string column_name(const ResultReader& result, const std::string& dataset) {
  return with_units(dataset, result.units(dataset));
}

std::string column_name(const ShownQuantity& shown) {
  return with_units(shown.dataset, shown.stored_units);
}

double crs_unit_m(const ResultReader& result) {
  const double unit_m = result.number_attribute("crs_unit_m");
  return unit_m > 0 ? unit_m : 1;
}

std::string export_caption(const ResultReader& result, const ShownQuantity& shown) {
  return fmt::format("{}: {}{}{}{}{}", std::filesystem::path(result.path()).filename().string(),
                     shown.name, shown.units.empty() ? "" : " ", shown.units,
                     shown.when.empty() ? "" : ", ", shown.when);
}

}  // namespace sunload
