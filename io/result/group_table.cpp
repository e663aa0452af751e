// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/result/group_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "geo/mesh/mesh.h"
#include "io/base/statistics.h"
#include "io/base/text.h"
#include "io/batch/facade_means.h"
#include "io/result/mesh_error.h"
#include "io/result/patch_groups.h"

namespace sunload {
namespace {

// Below this share of its length along the level a sensor looks straight up or down.
constexpr double upright = 1e-6;

/// What is known of every facade, object, selection or sensor, by its place in the file.
struct Values {
  std::vector<double> azimuth_deg, area, load, load_se, mesh_error, sun_hours, sky_view, largest;
  std::vector<Vec3> place;  ///< of sensors
};

/// Area-weighted means over the patches of every entry, and the largest of their values.
class OverPatches {
 public:
  OverPatches(const ResultReader& result, std::vector<std::int32_t> entry, std::size_t count)
      : result_(result),
        entry_(std::move(entry)),
        area_(count, 0),
        means_(entry_, result.doubles("patch_area"), count) {
    const auto patch_area = result.doubles("patch_area");
    for (std::size_t p = 0; p < entry_.size(); ++p)
      if (entry_[p] >= 0) area_[static_cast<std::size_t>(entry_[p])] += patch_area[p];
  }

  const std::vector<double>& area() const { return area_; }

  std::vector<double> mean(const std::string& dataset) const {
    if (!result_.has(dataset)) return std::vector<double>(area_.size(), not_known);
    return means_.of(result_.doubles(dataset), Divided::terms);
  }

  std::vector<double> largest(const std::string& dataset) const {
    std::vector<double> values(area_.size(), not_known);
    if (!result_.has(dataset)) return values;
    const auto of_patches = result_.doubles(dataset);
    for (std::size_t p = 0; p < entry_.size(); ++p) {
      if (entry_[p] < 0 || std::isnan(of_patches[p])) continue;
      double& value = values[static_cast<std::size_t>(entry_[p])];
      value = std::isnan(value) ? of_patches[p] : std::max(value, of_patches[p]);
    }
    return values;
  }

  /// Standard error of the mean over the realizations of [realization, patch].
  std::vector<double> error(const std::string& dataset) const {
    std::vector<std::vector<double>> samples(area_.size());
    if (result_.has(dataset))
      for (std::size_t r = 0; r < result_.shape(dataset).front(); ++r) {
        const auto means = means_.of(result_.row(dataset, r), Divided::terms);
        for (std::size_t k = 0; k < means.size(); ++k) samples[k].push_back(means[k]);
      }
    std::vector<double> errors;
    errors.reserve(samples.size());
    for (const auto& of_entry : samples) errors.push_back(sample_mean(of_entry).se);
    return errors;
  }

 private:
  const ResultReader& result_;
  std::vector<std::int32_t> entry_;
  std::vector<double> area_;
  FacadeMeans means_;
};

/// Standard errors of what has a column in [realization, n].
std::vector<double> errors_of_columns(const ResultReader& result, const std::string& dataset) {
  const auto shape = result.shape(dataset);
  const auto rows = result.doubles(dataset);
  std::vector<double> errors(shape.back()), samples(shape.front());
  for (std::size_t k = 0; k < errors.size(); ++k) {
    for (std::size_t r = 0; r < samples.size(); ++r) samples[r] = rows[r * errors.size() + k];
    errors[k] = sample_mean(samples).se;
  }
  return errors;
}

void expect_load(const ResultReader& result, const char* dataset) {
  if (!result.has(dataset))
    throw InputError({result.path()}, "no dataset " + std::string(dataset),
                     "the table says what falls on something",
                     "take a finished result of sunload run");
}

Values of_patches(const ResultReader& result, std::vector<std::int32_t> entry, std::size_t count) {
  expect_load(result, "light_load");
  const OverPatches patches(result, std::move(entry), count);
  Values v;
  v.azimuth_deg.assign(count, not_known);
  v.area = patches.area();
  v.load = patches.mean("light_load");
  v.load_se = patches.error("light_load_realization");
  v.mesh_error = mesh_errors(patches.mean("light_load_reflected"));
  v.sun_hours = patches.mean("sun_hours");
  v.sky_view = patches.mean("sky_view_factor");
  v.largest = patches.largest(dataset_name("irradiance_max", result.quantity()));
  return v;
}

Values of_facades(const ResultReader& result) {
  const std::size_t count = result.strings("facade_name").size();
  Values v = of_patches(result, result.integers("patch_facade"), count);
  v.azimuth_deg = result.doubles("facade_azimuth");
  if (result.has("facade_light_load")) v.load = result.doubles("facade_light_load");
  if (result.has("facade_light_load_realization"))
    v.load_se = errors_of_columns(result, "facade_light_load_realization");
  return v;
}

/// Each object has a row for every orientation, and one for its roofs.
class ObjectOrientations {
 public:
  explicit ObjectOrientations(const ResultReader& result)
      : objects_(result.strings("object_name")), facing_(orientations(result)) {
    const auto object = result.integers("patch_object"), surface = result.integers("patch_surface");
    const auto of_each = static_cast<std::int32_t>(rows_of_each());
    for (std::size_t p = 0; p < object.size(); ++p) {
      const bool is_roof = static_cast<Surface>(surface[p]) == Surface::roof;
      const std::int32_t facing = is_roof ? of_each - 1 : facing_.of_patch[p];
      entry_.push_back(facing < 0 ? -1 : object[p] * of_each + facing);
    }
  }

  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& object : objects_) {
      for (const auto& facing : facing_.names) all.push_back(fmt::format("{}/{}", object, facing));
      all.push_back(object + "/roof");
    }
    return all;
  }

  std::vector<std::size_t> rows_of(const std::vector<std::size_t>& objects) const {
    std::vector<std::size_t> rows;
    for (const std::size_t object : objects)
      for (std::size_t k = 0; k < rows_of_each(); ++k) rows.push_back(object * rows_of_each() + k);
    return rows;
  }

  Values values(const ResultReader& result) const {
    Values v = of_patches(result, entry_, objects_.size() * rows_of_each());
    const auto sectors = static_cast<double>(facing_.names.size());
    for (std::size_t row = 0; row < v.azimuth_deg.size(); ++row) {
      const std::size_t facing = row % rows_of_each();
      if (facing < facing_.names.size())
        v.azimuth_deg[row] = static_cast<double>(facing) * 360 / sectors;
    }
    return v;
  }

 private:
  std::size_t rows_of_each() const { return facing_.names.size() + 1; }

  std::vector<std::string> objects_;
  PatchDivision facing_;
  std::vector<std::int32_t> entry_;
};

/// They may overlap: one after the other.
Values of_selections(const ResultReader& result) {
  Values all;
  for (std::size_t k = 0; k < selection_names(result).size(); ++k) {
    const Values one = of_patches(result, selection_entries(result, k), 1);
    for (const auto member :
         {&Values::azimuth_deg, &Values::area, &Values::load, &Values::load_se, &Values::mesh_error,
          &Values::sun_hours, &Values::sky_view, &Values::largest})
      (all.*member).push_back((one.*member).front());
  }
  return all;
}

/// Azimuth of the scene's +y axis: what north is turned by.
double turn_deg(const ResultReader& result) {
  const double north = result.number_attribute("north_deg");
  return std::isnan(north) ? 0 : north;
}

Values of_sensors(const ResultReader& result) {
  expect_load(result, "sensor_light_load");
  const auto position = result.doubles("sensor_position"), normal = result.doubles("sensor_normal");
  Values v;
  v.load = result.doubles("sensor_light_load");
  const std::size_t count = v.load.size();
  const auto of = [&](const std::string& dataset) {
    return result.has(dataset) ? result.doubles(dataset) : std::vector<double>(count, not_known);
  };
  v.area.assign(count, not_known);
  for (std::size_t s = 0; s < count; ++s) {
    const Vec3 towards{normal[3 * s], normal[3 * s + 1], normal[3 * s + 2]};
    v.azimuth_deg.push_back(std::hypot(towards.x, towards.y) < upright
                                ? not_known
                                : wrapped_deg(horizontal(towards).azimuth_deg + turn_deg(result)));
    v.place.push_back(result.origin() +
                      Vec3{position[3 * s], position[3 * s + 1], position[3 * s + 2]});
  }
  v.load_se = result.has("sensor_light_load_realization")
                  ? errors_of_columns(result, "sensor_light_load_realization")
                  : of("sensor_light_load_se");
  v.sun_hours = of("sensor_sun_hours");
  v.sky_view = of("sensor_sky_view_factor");
  v.largest = of(dataset_name("sensor_irradiance_max", result.quantity()));
  return v;
}

std::vector<double> times(std::vector<double> values, const std::vector<double>& factor) {
  for (std::size_t k = 0; k < values.size(); ++k) values[k] *= factor[k];
  return values;
}

std::vector<double> component(const std::vector<Vec3>& places, double Vec3::*axis) {
  std::vector<double> values;
  values.reserve(places.size());
  for (const Vec3& p : places) values.push_back(p.*axis);
  return values;
}

std::vector<TableColumn> columns_of(const Values& v, Quantity quantity) {
  const auto units = [&](const char* text) { return display_units(light_units(text, quantity)); };
  const auto key = [&](const char* text) { return unit_names(text, quantity); };
  std::vector<TableColumn> columns{
      {"azimuth_deg", "azimuth", "°", "{:.0f}", v.azimuth_deg},
      {"area_m2", "area", "m²", "{:.1f}", v.area},
      {key("light_load_kwh_m2"), "light load", units("kWh m-2"), "{:.4g}", v.load},
      {key("light_load_se_kwh_m2"), "±", units("kWh m-2"), "{:.2g}", v.load_se},
      {key("energy_kwh"), "energy", units("kWh"), "{:.5g}", times(v.load, v.area)},
      {key("energy_se_kwh"), "±", units("kWh"), "{:.2g}", times(v.load_se, v.area)},
      {"sun_hours_h", "sun", "h", "{:.1f}", v.sun_hours},
      {"sky_view_factor", "sky view", "", "{:.3f}", v.sky_view},
      {quantity == Quantity::illuminance ? "illuminance_max_lx" : "irradiance_max_w_m2", "largest",
       units("W m-2"), "{:.4g}", v.largest}};
  if (v.place.empty()) {
    columns.push_back({key("mesh_error_kwh_m2"), "mesh", units("kWh m-2"), "{:.2g}", v.mesh_error});
    return columns;
  }
  columns.push_back({"x_m", "x", "m", "{:.2f}", component(v.place, &Vec3::x)});
  columns.push_back({"y_m", "y", "m", "{:.2f}", component(v.place, &Vec3::y)});
  columns.push_back({"z_m", "z", "m", "{:.2f}", component(v.place, &Vec3::z)});
  return columns;
}

/// The rows that were chosen; what has no area (all of it covered) has none.
GroupTable chosen_rows(TableOf of, const std::vector<std::string>& names,
                       const std::vector<std::size_t>& chosen, const Values& values,
                       Quantity quantity) {
  GroupTable table{of, {}, {}, {}};
  for (const auto k : chosen) {
    if (values.area[k] == 0) continue;
    table.entries.push_back(k);
    table.names.push_back(names[k]);
  }
  for (const TableColumn& all : columns_of(values, quantity)) {
    auto& column =
        table.columns.emplace_back(TableColumn{all.key, all.word, all.units, all.format, {}});
    for (const auto k : table.entries) column.values.push_back(all.values[k]);
  }
  return table;
}

void expect_own_kind(TableOf of, const NamedParts& parts) {
  Problems problems;
  const auto refuse = [&](TableOf kind, const char* word, const auto& names) {
    // Orientations are those of objects.
    const bool is_own = of == kind || (of == TableOf::orientations && kind == TableOf::objects);
    if (!is_own && !names.empty())
      problems.add({}, fmt::format("--{} {} in another table", word, names.front()),
                   "a table holds facades, objects, orientations, selections or sensors",
                   fmt::format("choose the table of {0}s, or name its own rows, e.g. --facade "
                               "'house_3/*' among facades",
                               word));
  };
  refuse(TableOf::facades, "facade", parts.facades);
  refuse(TableOf::objects, "object", parts.objects);
  refuse(TableOf::selections, "selection", parts.selections);
  refuse(TableOf::sensors, "sensor", parts.sensors);
  problems.throw_if_any();
}

}  // namespace

GroupTable group_table(const ResultReader& result, TableOf of, const NamedParts& parts) {
  expect_own_kind(of, parts);
  const auto rows = [&](const std::string& kind, const std::vector<std::string>& names,
                        const std::vector<std::size_t>& chosen, const auto& values) {
    const bool is_a_section = kind == "selections" || kind == "sensors";
    if (names.empty())
      throw InputError(
          {result.path()}, "the result has no " + kind,
          is_a_section ? "its study has no section " + kind : "there is nothing to list",
          is_a_section ? "write one and run the study again" : "");
    return chosen_rows(of, names, chosen, values(result), result.quantity());
  };
  switch (of) {
    case TableOf::facades:
      return rows("facades", result.strings("facade_name"), chosen_facades(result, parts),
                  of_facades);
    case TableOf::objects: {
      const auto names = result.strings("object_name");
      return rows("objects", names, chosen_objects(result, parts), [&](const ResultReader& r) {
        return of_patches(r, r.integers("patch_object"), names.size());
      });
    }
    case TableOf::orientations: {
      const ObjectOrientations all(result);
      return rows("objects", all.names(), all.rows_of(chosen_objects(result, parts)),
                  [&](const ResultReader& r) { return all.values(r); });
    }
    case TableOf::selections:
      return rows("selections", selection_names(result), chosen_selections(result, parts),
                  of_selections);
    case TableOf::sensors:
      break;
  }
  return rows("sensors", sensor_names(result), chosen_sensors(result, parts), of_sensors);
}

std::string group_table_csv(const GroupTable& table) {
  std::string text = "name";
  for (const auto& column : table.columns) text += "," + column.key;
  text += "\n";
  for (std::size_t row = 0; row < table.names.size(); ++row) {
    text += csv_text(table.names[row]);
    for (const auto& column : table.columns) text += "," + csv_number(column.values[row]);
    text += "\n";
  }
  return text;
}

}  // namespace sunload
