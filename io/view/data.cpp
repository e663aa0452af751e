// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/view/data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <utility>

#include "geo/base/check.h"
#include "geo/time/time.h"
#include "io/base/half_float.h"
#include "io/base/text.h"
#include "io/result/measure_table.h"
#include "io/result/schema.h"
#include "io/result/time.h"
#include "io/view/scale_of_times.h"

namespace sunload {
namespace {

using nlohmann::json;

// Rows of a series read at a time: results are chunked by 64 rows or so.
constexpr std::size_t rows_at_a_time = 64;

std::vector<float> floats(const std::vector<double>& values) {
  return {values.begin(), values.end()};
}

/// Middle of the box around all vertices: floats near it are finer than a tenth of a millimetre.
std::vector<double> middle(const std::vector<double>& vertices) {
  std::vector<double> centre;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double least = std::numeric_limits<double>::infinity(), largest = -least;
    for (std::size_t i = axis; i < vertices.size(); i += 3) {
      least = std::min(least, vertices[i]);
      largest = std::max(largest, vertices[i]);
    }
    centre.push_back((least + largest) / 2);
  }
  return centre;
}

json geometry(const ResultReader& result, ViewBlocks& blocks) {
  auto vertices = result.doubles("vertex_position");
  const auto centre = middle(vertices);
  for (std::size_t i = 0; i < vertices.size(); ++i) vertices[i] -= centre[i % 3];
  json j{{"centre", centre}, {"vertices", blocks.add(floats(vertices))}};
  for (const auto* name :
       {"patch_vertices", "patch_object", "patch_facade", "patch_material", "patch_surface",
        "patch_side", "patch_input_triangle", "input_triangle_vertices"})
    j[name] = blocks.add(result.integers(name));
  for (const auto* name : {"patch_area", "patch_normal"})
    j[name] = blocks.add(floats(result.doubles(name)));
  for (const auto* name : {"object_name", "facade_name", "material_name"})
    j[name] = result.has(name) ? result.strings(name) : std::vector<std::string>{};
  for (const auto* name : {"facade_azimuth", "facade_area", "facade_light_load_se"})
    if (result.has(name)) j[name] = result.doubles(name);
  return j;
}

/// Of when a total is: the period, or the day of a measure; of the shapes alone no time.
std::string when_of(const ResultReader& result, const std::string& name) {
  if (auto day = result.text_attribute(name, "when"); !day.empty()) return day;
  return name.starts_with("sky_view_factor") ? std::string() : period_in_words(result);
}

json totals(const ResultReader& result, ViewBlocks& blocks) {
  json list = json::array();
  for (const auto& variable : result_schema()) {
    const std::string name(variable.name);
    if (variable.dims != "patch" || variable.units.empty() || is_of_mean(name) ||
        !result.has(name) || variable.name == "patch_area")
      continue;
    list.push_back({{"name", name},
                    {"what", variable.long_name},
                    {"when", when_of(result, name)},
                    {"units", display_units(result.units(name))},
                    {"values", blocks.add(floats(result.doubles(name)))}});
  }
  for (const auto& measure : measure_names(result)) {
    const std::string name = std::string(measure_prefix) + measure;
    const auto values = floats(result.doubles(name));  // NaN where nothing is measured
    list.push_back({{"name", name},
                    {"what", result.text_attribute(name, "definition")},
                    {"when", when_of(result, name)},
                    {"units", display_units(result.units(name))},
                    {"values", blocks.add(values)}});
  }
  return list;
}

/// Of every interval; NaN where a result lacks it.
std::vector<double> known_ghi(const ResultReader& result) {
  auto ghi = result.doubles("ghi");
  if (result.lacking().empty() || !result.has("power_sun")) return ghi;
  const auto power = result.doubles("power_sun");
  const std::size_t bands = power.size() / std::max<std::size_t>(ghi.size(), 1);
  for (std::size_t k = 0; k < ghi.size(); ++k)
    if (std::isnan(power.at(k * bands))) ghi[k] = power[k * bands];
  return ghi;
}

json times(const ResultReader& result, std::size_t step) {
  const auto zone = result_zone(result);
  const auto time = result.doubles("time"), bounds = result.doubles("time_bounds"),
             direction = result.doubles("sun_direction"), azimuth = result.doubles("sun_azimuth"),
             elevation = result.doubles("sun_elevation");
  const auto ghi = known_ghi(result), shares = result.chosen_shares();
  const bool is_synthetic = has_no_dates(result);
  json list = json::array();
  for (std::size_t i = 0; i < time.size(); i += step)
    list.push_back({{"begin", bounds[2 * i]},
                    {"end", bounds[2 * i + 1]},
                    {"local_begin", is_synthetic ? "" : iso_local(bounds[2 * i], zone)},
                    {"local_end", is_synthetic ? "" : iso_local(bounds[2 * i + 1], zone)},
                    {"sun", {direction[3 * i], direction[3 * i + 1], direction[3 * i + 2]}},
                    {"azimuth", azimuth[i]},
                    {"elevation", elevation[i]},
                    {"ghi", ghi.at(i)},
                    {"share", shares.at(i)}});
  return list;
}

double largest_value(const ResultReader& result, const std::string& name, std::size_t intervals) {
  double largest = 0;
  for (std::size_t first = 0; first < intervals; first += rows_at_a_time)
    for (const double value : result.rows(name, first, std::min(rows_at_a_time, intervals - first)))
      if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  return largest;
}

/// Rows one after the other, each as the low bytes of all patches and then the high bytes. With
/// `area` of the columns also where a scale of all rows ends.
json series(const ResultReader& result, const std::string& name, std::size_t step,
            ViewBlocks& blocks, const std::vector<double>& area = {}) {
  if (name.empty()) return nullptr;
  const auto shape = result.shape(name);
  const std::size_t intervals = shape.at(0), patches = shape.at(1);
  const double largest = largest_value(result, name, intervals);
  // The largest half is just below 2^16: the largest value fills the range.
  constexpr int half_exponent = 16;
  int exponent = 0;
  std::frexp(largest, &exponent);
  const double scale = largest > 0 ? std::ldexp(1.0, half_exponent - 1 - exponent) : 1;
  ScaleOfTimes scale_of_times(area);
  Bytes planes;
  planes.reserve((intervals + step - 1) / step * patches * 2);
  for (std::size_t first = 0; first < intervals; first += rows_at_a_time) {
    const std::size_t count = std::min(rows_at_a_time, intervals - first);
    const auto values = result.rows(name, first, count);
    for (std::size_t r = 0; r < count; ++r) {
      if ((first + r) % step != 0) continue;
      if (!area.empty())
        scale_of_times.add({values.begin() + static_cast<std::ptrdiff_t>(r * patches),
                            values.begin() + static_cast<std::ptrdiff_t>((r + 1) * patches)});
      const std::size_t low = planes.size(), high = low + patches;
      planes.resize(low + 2 * patches);
      for (std::size_t p = 0; p < patches; ++p) {
        const auto bits = half_bits(static_cast<float>(values[r * patches + p] * scale));
        planes[low + p] = static_cast<unsigned char>(bits & 0xffU);
        planes[high + p] = static_cast<unsigned char>(bits >> 8);
      }
    }
  }
  return {{"name", name},
          {"units", display_units(result.units(name))},
          {"scale", scale},
          {"end", scale_of_times.end()},
          {"values", blocks.add(planes)}};
}

/// The same of facades, whose series are there where patches have none; null where there is
/// neither.
json facade_series(const ResultReader& result, std::size_t step, ViewBlocks& blocks) {
  for (const std::string name : {"irradiance", "illuminance"}) {
    const std::string of_facades = "facade_" + name;
    if (!result.has(of_facades) || result.shape(of_facades).size() != 2) continue;
    auto own = series(result, of_facades, step, blocks);
    own["name"] = name;
    return own;
  }
  return nullptr;
}

// Divisions of the period whose totals the page shows; of days of a year it would have too many.
constexpr std::array shown_divisions{"month", "season", "day"};
constexpr std::size_t most_parts = 31;

/// Light loads of parts of the period, [part, patch], where they are stored.
json divisions(const ResultReader& result, ViewBlocks& blocks) {
  json list = json::array();
  for (const std::string division : shown_divisions) {
    const std::string name = "light_load_by_" + division;
    if (!result.has(name) || !result.has(division) || result.shape(name).at(0) > most_parts)
      continue;
    list.push_back({{"name", division},
                    {"parts", result.strings(division)},
                    {"units", display_units(result.units(name))},
                    {"values", blocks.add(floats(result.doubles(name)))}});
  }
  return list;
}

/// Points of the study that receive light; names as those of patches. Null where there are none.
json sensors(const ResultReader& result, std::size_t step, ViewBlocks& blocks) {
  if (!result.has("sensor_position")) return nullptr;
  const std::string prefix = "sensor_";
  const auto centre = middle(result.doubles("vertex_position"));
  auto position = result.doubles("sensor_position");
  for (std::size_t i = 0; i < position.size(); ++i) position[i] -= centre[i % 3];
  json values = json::array();
  for (const auto& variable : result_schema(result.quantity())) {
    const std::string name(variable.name);
    if (variable.dims != "sensor" || variable.units.empty() || is_of_mean(name) ||
        !result.has(name))
      continue;
    values.push_back({{"name", name.substr(prefix.size())},
                      {"units", display_units(result.units(name))},
                      {"values", blocks.add(floats(result.doubles(name)))}});
  }
  const auto of_patches = viewed_series(result);
  auto own = result.has(prefix + of_patches) ? series(result, prefix + of_patches, step, blocks)
                                             : json(nullptr);
  if (!own.is_null()) own["name"] = of_patches;
  return {{"position", blocks.add(floats(position))},
          {"totals", std::move(values)},
          {"series", std::move(own)}};
}

/// Of a result in bands which of them its values are of; empty of others.
std::string band_in_words(const ResultReader& result) {
  if (result.band()) return std::string(band_names[*result.band()]) + " band";
  return result.bands() == Bands::rgb ? "mean of the bands" : "";
}

}  // namespace

std::string viewed_series(const ResultReader& result) {
  for (const auto* name : {"irradiance", "illuminance"})
    if (result.has(name) && result.shape(name).size() == 2) return name;
  return {};
}

json view_data(const ResultReader& result, std::size_t step, ViewBlocks& blocks) {
  const auto zone = result.text_attribute("timezone");
  const Vec3 origin = result.origin();
  return {{"study", result.text_attribute("study")},
          {"variant", result.text_attribute("variant")},
          {"file", std::filesystem::path(result.path()).stem().string()},
          {"folder", std::filesystem::absolute(result.path()).parent_path().filename().string()},
          {"part", result.chosen().words()},
          {"band", band_in_words(result)},
          {"lacking", result.lacking()},
          {"source", result.text_attribute("source")},
          {"timezone", zone.empty() ? "UTC" : zone},
          {"is_synthetic", has_no_dates(result)},
          {"intervals", result.shape("time").at(0)},
          {"step", step},
          {"has_sun", !has_long_steps(result)},
          {"series_step", series_step(result)},
          {"times", times(result, step)},
          {"geometry", geometry(result, blocks)},
          {"totals", totals(result, blocks)},
          {"divisions", divisions(result, blocks)},
          {"sensors", sensors(result, step, blocks)},
          {"origin", {origin.x, origin.y, origin.z}},
          {"facade_series", facade_series(result, step, blocks)},
          {"series",
           series(result, viewed_series(result), step, blocks, result.doubles("patch_area"))}};
}

json view_data(const TwoResults& two, ViewBlocks& blocks) {
  json pairs{{"is_same", two.is_same}};
  if (!two.is_same) {
    pairs["count"] = blocks.add(two.count);
    pairs["patch"] = blocks.add(two.patch);
    pairs["area"] = blocks.add(two.area);
  }
  return {{"pairs", std::move(pairs)}, {"end", two.end ? json(*two.end) : json()}};
}

}  // namespace sunload
