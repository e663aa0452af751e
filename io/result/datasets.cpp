// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/result/datasets.h"

#include <array>
#include <cmath>

#include "io/base/bands.h"
#include "io/result/own_seasons.h"

namespace sunload {
namespace {

constexpr std::array<const char*, 2> side_names{"front", "back"};

template <class Names>
std::string flag_meanings(const Names& names) {
  std::string words;
  for (const char* name : names) {
    if (!words.empty()) words += ' ';
    words += name;
  }
  return words;
}

std::vector<double> flags_of(std::size_t count) {
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = static_cast<double>(i);
  return values;
}

std::vector<double> flat(const std::vector<Vec3>& points) {
  std::vector<double> values;
  values.reserve(3 * points.size());
  for (const Vec3& p : points) values.insert(values.end(), {p.x, p.y, p.z});
  return values;
}

template <class Value, std::size_t n>
std::vector<Value> flat(const std::vector<std::array<Value, n>>& rows) {
  std::vector<Value> values;
  values.reserve(n * rows.size());
  for (const auto& row : rows) values.insert(values.end(), row.begin(), row.end());
  return values;
}

std::vector<double> components(const std::vector<Vec3>& points, double Vec3::*component) {
  std::vector<double> values;
  values.reserve(points.size());
  for (const Vec3& p : points) values.push_back(p.*component);
  return values;
}

bool has_patches(const std::vector<std::string>& dims) {
  return std::find(dims.begin(), dims.end(), "patch") != dims.end();
}

}  // namespace

ResultWriter::File::~File() {
  scales.clear();
  if (file) file->abandon();
}

const ResultVariable& ResultWriter::File::variable(const std::string& name) const {
  const ResultVariable* found = find_result_variable(stored(name), options.quantity);
  SUNLOAD_EXPECT(found != nullptr, "the schema has no dataset " + name);
  return *found;
}

void ResultWriter::File::create_dimension(const std::string& name, std::size_t size) {
  // The words by which netCDF-4 knows a dimension without a variable.
  constexpr const char* no_variable = "This is a netCDF dimension but not a netCDF variable. ";
  constexpr std::size_t digits = 10;
  const std::string number = std::to_string(size);
  sizes[name] = size;
  h5::Dataset scale = file->create_dataset(name, {h5::Type::float32, {size}, {}, 0});
  scale.make_scale(no_variable + std::string(digits - std::min(digits, number.size()), ' ') +
                   number);
  scales.emplace(name, scale);
}

void ResultWriter::File::put_labels(const std::string& dimension,
                                    const std::vector<std::string>& names) {
  sizes[dimension] = names.size();
  put(dimension, names);
}

h5::Dataset ResultWriter::File::create(const ResultVariable& of,
                                       const std::vector<std::string>& dims) {
  h5::DatasetSpec spec{of.type, {}, {}, options.compression};
  for (const auto& dim : dims) spec.shape.push_back(sizes.at(dim));
  const bool is_floating = of.type == h5::Type::float32 || of.type == h5::Type::float64;
  const bool is_fillable =
      is_floating && of.part != ResultPart::coordinate && of.part != ResultPart::division;
  if (is_fillable) spec.unwritten = h5::DatasetSpec::Unwritten::nan;
  if (of.part == ResultPart::series && spec.shape.front() > 0 && spec.shape.back() > 0) {
    const ChunkShape shape = chunk_shape(spec.shape.back());
    spec.chunk.assign(spec.shape.size(), 1);
    spec.chunk.front() = shape.rows;
    spec.chunk.back() = shape.columns;
  }
  h5::Dataset dataset = file->create_dataset(std::string(of.name), spec);
  if (is_coordinate_of_itself(of)) {
    dataset.make_scale(std::string(of.name));
    scales.emplace(std::string(of.name), dataset);
  } else {
    for (std::size_t i = 0; i < dims.size(); ++i) dataset.attach_scale(i, scales.at(dims[i]));
  }
  if (is_fillable) dataset.set("_FillValue", std::nan(""), of.type);
  dataset.set("long_name", std::string(of.long_name));
  if (!of.units.empty()) dataset.set("units", std::string(of.units));
  if (!of.standard_name.empty()) dataset.set("standard_name", std::string(of.standard_name));
  if (!of.cell_methods.empty()) dataset.set("cell_methods", std::string(of.cell_methods));
  if (has_patches(dims) && of.name != "patch_vertices") {
    dataset.set("mesh", "mesh");
    dataset.set("location", "face");
  }
  return dataset;
}

std::vector<std::string> ResultWriter::File::dimensions_of(const ResultVariable& of) const {
  const auto names = dimension_names(of);
  return is_rgb() && has_bands(of) ? with_band(names) : names;
}

void ResultWriter::File::put_dimensions(const ResultGeometry& geometry) {
  constexpr std::size_t corners = 3, coordinates = 3, ends = 2;
  create_dimension("bounds", ends);
  create_dimension("xyz", coordinates);
  create_dimension("corner", corners);
  create_dimension("vertex", geometry.vertices.size());
  create_dimension("patch", geometry.patch_vertices.size());
  create_dimension("input_triangle", geometry.input_triangle_vertices.size());
  put_labels("object", geometry.object_name);
  put_labels("facade", geometry.facade_name);
  put_labels("material", geometry.material_name);
  if (!geometry.selection_name.empty()) put_labels("selection", geometry.selection_name);
  create_dimension("realization", options.realizations);
  if (!geometry.sensor_position.empty())
    create_dimension("sensor", geometry.sensor_position.size());
}

void ResultWriter::File::put_times(const ResultTimes& times) {
  sizes["time"] = times.time.size();
  bounds = times.bounds;
  appended.assign((times.time.size() + options.chunk_intervals - 1) / options.chunk_intervals, 0);
  for (std::size_t i = 0; i < times.time.size(); ++i) {
    SUNLOAD_EXPECT(i == 0 || times.time[i] > times.time[i - 1], "time strictly increases");
  }
  h5::Dataset time = put("time", times.time);
  time.set("bounds", "time_bounds");
  time.set("calendar", "standard");
  time.set("axis", "T");
  if (options.times_are_synthetic) time.set("time_is_synthetic", std::int64_t{1});
  if (!options.series_step.empty()) {
    time.set("long_name", "instant of the sun half way through the sunlit time of the step");
    time.set("series_step", options.series_step);
  }
  put("time_bounds", flat(times.bounds));
  put("sun_azimuth", times.sun_azimuth_deg);
  put("sun_elevation", times.sun_elevation_deg);
  put("sun_direction", flat(times.sun_direction));
  put("dni", times.dni);
  put("dhi", times.dhi);
  put("ghi", times.ghi);
  put_study_seasons(times);
  if (options.quantity != Quantity::illuminance) return;
  put("direct_normal_illuminance", times.direct_illuminance);
  put("diffuse_horizontal_illuminance", times.diffuse_illuminance);
  put("global_horizontal_illuminance", times.global_illuminance);
}

void ResultWriter::File::put_study_seasons(const ResultTimes& times) {
  if (times.season_names.empty()) return;
  h5::Dataset seasons = put("study_seasons", times.study_seasons);
  std::vector<double> masks;
  std::string words;
  for (const std::string& name : times.season_names) {
    words += (words.empty() ? "" : " ") + flag_word(name);
    masks.push_back(masks.empty() ? 1 : 2 * masks.back());
  }
  seasons.set("flag_masks", masks, h5::Type::int32);
  seasons.set("flag_meanings", words);
}

void ResultWriter::File::put_vertices(const ResultGeometry& geometry) {
  const Vec3 origin = geometry.origin;
  file->set("origin", {origin.x, origin.y, origin.z}, h5::Type::float64);
  put("vertex_position", flat(geometry.vertices))
      .set("origin", {origin.x, origin.y, origin.z}, h5::Type::float64);
  put("vertex_x", components(geometry.vertices, &Vec3::x));
  put("vertex_y", components(geometry.vertices, &Vec3::y));
  put("vertex_z", components(geometry.vertices, &Vec3::z));
}

void ResultWriter::File::put_mesh_topology() {
  h5::Dataset mesh = put("mesh", std::vector<std::int32_t>{0});
  mesh.set("cf_role", "mesh_topology");
  mesh.set("topology_dimension", 2.0, h5::Type::int32);
  mesh.set("node_coordinates", "vertex_x vertex_y vertex_z");
  mesh.set("node_dimension", "vertex");
  mesh.set("face_node_connectivity", "patch_vertices");
  mesh.set("face_dimension", "patch");
}

void ResultWriter::File::put_patches(const ResultGeometry& geometry) {
  const auto widened = [](const std::vector<std::uint8_t>& values) {
    return std::vector<std::int32_t>(values.begin(), values.end());
  };
  h5::Dataset vertices = put("patch_vertices", flat(geometry.patch_vertices));
  vertices.set("cf_role", "face_node_connectivity");
  vertices.set("start_index", 0.0, h5::Type::int32);
  put("patch_area", geometry.patch_area);
  put("patch_centroid", flat(geometry.patch_centroid));
  put("patch_normal", flat(geometry.patch_normal));
  put("patch_object", geometry.patch_object);
  put("patch_facade", geometry.patch_facade);
  put("patch_material", geometry.patch_material);
  h5::Dataset surface = put("patch_surface", widened(geometry.patch_surface));
  surface.set("flag_values", flags_of(surface_names.size()), h5::Type::int8);
  surface.set("flag_meanings", flag_meanings(surface_names));
  h5::Dataset side = put("patch_side", widened(geometry.patch_side));
  side.set("flag_values", flags_of(side_names.size()), h5::Type::int8);
  side.set("flag_meanings", flag_meanings(side_names));
  put("patch_input_triangle", geometry.patch_input_triangle);
  put("input_triangle_vertices", flat(geometry.input_triangle_vertices))
      .set("start_index", 0.0, h5::Type::int32);
}

void ResultWriter::File::put_groups(const ResultGeometry& geometry) {
  put("object_name", geometry.object_name);
  put("facade_name", geometry.facade_name);
  put("material_name", geometry.material_name);
  put("facade_area", geometry.facade_area);
  put("facade_azimuth", geometry.facade_azimuth_deg);
  if (geometry.selection_name.empty()) return;
  put("selection_name", geometry.selection_name);
  put("selection_area", geometry.selection_area);
  std::vector<std::int32_t> flags;
  for (const auto& of_patches : geometry.selected)
    flags.insert(flags.end(), of_patches.begin(), of_patches.end());
  put("patch_selected", flags);
}

void ResultWriter::File::put_sensors(const ResultGeometry& geometry) {
  if (geometry.sensor_position.empty()) return;
  const Vec3 origin = geometry.origin;
  put("sensor_position", flat(geometry.sensor_position))
      .set("origin", {origin.x, origin.y, origin.z}, h5::Type::float64);
  put("sensor_normal", flat(geometry.sensor_normal));
}

void ResultWriter::File::put_bands() {
  if (!is_rgb()) return;
  sizes["band"] = band_count;
  put("band", std::vector<std::string>(band_names.begin(), band_names.end()));
}

void ResultWriter::File::put_divisions(const ResultGeometry& geometry) {
  for (const auto& division : options.divisions) put_division(division, geometry);
}

void ResultWriter::File::put_division(const ResultDivision& division,
                                      const ResultGeometry& geometry) {
  const std::string& name = division.name;
  sizes[name] = division.label.size();
  if (variable(name).type == h5::Type::text) {
    put(name, division.label);
  } else {
    std::vector<std::int32_t> numbers;
    for (const auto& label : division.label) numbers.push_back(std::stoi(label));
    put(name, numbers);
  }
  if (!division.bounds.empty()) put(name + "_bounds", flat(division.bounds));
  put(name + "_duration", division.duration_h);
  for (const auto& of : result_schema()) {
    const auto dims = dimension_names(of);
    if (of.part != ResultPart::total || dims.size() < 2 || dims.front() != name) continue;
    const bool is_of_errors = of.name.ends_with("_se") || of.name.ends_with("_realization");
    if (is_of_errors && !division.with_errors) continue;
    if (dims.back() == "facade" && geometry.facade_name.empty()) continue;
    if (dims.back() == "sensor" && geometry.sensor_position.empty()) continue;
    h5::Dataset dataset = create(std::string(of.name));
    const auto shape = dataset.shape();
    std::size_t row = 1;
    for (std::size_t axis = 1; axis < shape.size(); ++axis) row *= shape[axis];
    // Now, so that its place is among what the seal covers, before that of the series.
    if (row > 0) dataset.write_rows(0, 1, std::vector<double>(row, std::nan("")).data());
  }
}

}  // namespace sunload
