// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/result/patches_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "geo/mesh/mesh.h"
#include "io/base/text.h"
#include "io/result/schema.h"
#include "io/result/shown_quantity.h"

namespace sunload {
namespace {

/// A dataset [patch], or nothing where the result lacks it.
struct Column {
  std::string dataset;
  std::string header;
  std::vector<double> values;
};

/// "light_given_kwh_m4"
std::string header_of(const ResultVariable& variable) {
  return std::string(variable.name) + (variable.units == "1" ? "" : "_kwh_m4");
}

/// Columns that every result has, those it lacks empty: programs find them in their place.
constexpr std::array always_there{"light_load",           "light_load_se",     "light_load_direct",
                                  "light_load_sky",       "light_load_mirror", "light_load_lamps",
                                  "light_load_reflected", "sun_hours",         "power_load"};

/// Units of `always_there` where a result lacks it.
std::string units_of(const ResultReader& result, const std::string& dataset) {
  if (result.has(dataset)) return result.units(dataset);
  return dataset == "sun_hours" ? "h" : result.units("light_load");
}

std::vector<Column> columns_of_totals(const ResultReader& result) {
  std::vector<Column> columns;
  const auto add = [&](const std::string& dataset) {
    columns.push_back({dataset, with_units(dataset, units_of(result, dataset)), {}});
  };
  for (const std::string dataset : always_there) add(dataset);
  for (const auto& dataset : patch_datasets(result, PatchDatasets::totals))
    if (dataset != "patch_area" &&
        std::find(always_there.begin(), always_there.end(), dataset) == always_there.end())
      add(dataset);
  return columns;
}

std::vector<Column> columns_of_comparison(const ResultReader& result) {
  const std::string compared = result.compared(), difference = difference_dataset(compared);
  std::vector<Column> columns;
  for (const auto& [dataset, header] : {std::pair{"base_" + compared, "base"},
                                        {"variant_" + compared, "variant"},
                                        {difference, "difference"},
                                        {difference + "_se", "se"}})
    columns.push_back({dataset, with_units(header, result.units(dataset)), {}});
  return columns;
}

std::vector<Column> columns_of_place_map() {
  std::vector<Column> columns;
  for (const auto& variable : place_map_schema())
    columns.push_back({std::string(variable.name), header_of(variable), {}});
  return columns;
}

std::vector<Column> value_columns(const ResultReader& result) {
  auto columns = result.is_comparison()  ? columns_of_comparison(result)
                 : result.is_place_map() ? columns_of_place_map()
                                         : columns_of_totals(result);
  for (auto& column : columns)
    if (result.has(column.dataset)) column.values = result.doubles(column.dataset);
  return columns;
}

/// Names of a table as fields of CSV; the entry -1 is empty.
class Names {
 public:
  explicit Names(const std::vector<std::string>& names) {
    for (const auto& name : names) fields_.push_back(csv_text(name));
  }
  const std::string& operator[](std::int32_t entry) const {
    return entry < 0 ? none_ : fields_.at(static_cast<std::size_t>(entry));
  }

 private:
  std::vector<std::string> fields_;
  std::string none_;
};

}  // namespace

std::string patches_csv(const ResultReader& result, const NamedParts& parts) {
  const Names objects(result.strings("object_name")), facades(result.strings("facade_name")),
      materials(result.strings("material_name")),
      surfaces({surface_names.begin(), surface_names.end()});
  const auto object = result.integers("patch_object"), facade = result.integers("patch_facade"),
             surface = result.integers("patch_surface"),
             material = result.integers("patch_material"), side = result.integers("patch_side");
  const auto area = result.doubles("patch_area"), centroid = result.doubles("patch_centroid"),
             normal = result.doubles("patch_normal");
  const auto columns = value_columns(result);

  fmt::memory_buffer text;
  auto out = std::back_inserter(text);
  fmt::format_to(out,
                 "index,object,facade,surface,material,side,area_m2,centroid_x_m,centroid_y_m,"
                 "centroid_z_m,normal_x,normal_y,normal_z");
  for (const auto& column : columns)
    fmt::format_to(out, ",{}", unit_names(column.header, result.quantity()));
  fmt::format_to(out, "\n");
  for (const std::size_t i : chosen_patches(result, parts)) {
    fmt::format_to(out, "{},{},{},{},{},{},{}", i, objects[object[i]], facades[facade[i]],
                   surfaces[surface[i]], materials[material[i]], side[i], csv_number(area[i]));
    for (const auto* vectors : {&centroid, &normal})
      for (std::size_t axis = 0; axis < 3; ++axis)
        fmt::format_to(out, ",{}", csv_number((*vectors)[3 * i + axis]));
    for (const auto& column : columns)
      fmt::format_to(out, ",{}",
                     column.values.empty() ? std::string() : csv_number(column.values[i]));
    fmt::format_to(out, "\n");
  }
  return fmt::to_string(text);
}

}  // namespace sunload
