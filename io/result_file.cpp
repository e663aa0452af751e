#include "io/result_file.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "geo/check.h"
#include "geo/units.h"
#include "io/bands.h"
#include "io/chunk.h"
#include "io/file_aside.h"
#include "io/h5.h"
#include "io/result_schema.h"
#include "io/result_seal.h"

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
  for (const Vec3& p : points) values.push_back(p.*component);
  return values;
}

bool has_patches(const std::vector<std::string>& dims) {
  return std::find(dims.begin(), dims.end(), "patch") != dims.end();
}

/// One number, or one per band.
void set_values(h5::Dataset& dataset, const std::string& attribute,
                const std::vector<double>& values) {
  if (values.size() == 1) dataset.set(attribute, values.front(), h5::Type::float64);
  else dataset.set(attribute, values, h5::Type::float64);
}

/// Ledger terms end without it, their standard errors with it.
bool is_standard_error(std::string_view name) { return name.ends_with("_se"); }

}  // namespace

/// The file while it is being written.
struct ResultWriter::File {
  FileAside target;
  Options options;
  std::optional<h5::File> file;
  std::map<std::string, std::size_t> sizes;  ///< of the dimensions
  std::map<std::string, h5::Dataset> scales;
  std::vector<std::array<double, 2>> bounds;
  std::vector<char> appended;  ///< by batch
  Extent series;               ///< bytes of the file written while batches came in
  std::map<std::string, std::vector<double>> time_sum_se_kwh;  ///< one value, or one per band

  File(const std::string& path, const Options& with) : target(path), options(with) {}
  ~File() {
    scales.clear();
    if (file) file->abandon();
  }

  /// Does what writes, with the library's errors as the machine's.
  template <class Action>
  void writing(const Action& action) {
    try {
      action();
    } catch (const h5::Error& error) {
      throw MachineError("cannot write " + target.path() + ": " + error.what());
    }
  }

  /// Name in this result of what is called so where it is irradiance.
  std::string stored(const std::string& name) const { return dataset_name(name, options.quantity); }

  const ResultVariable& variable(const std::string& name) const {
    const ResultVariable* found = find_result_variable(stored(name), options.quantity);
    SUNLOAD_EXPECT(found != nullptr, "the schema has no dataset " + name);
    return *found;
  }

  bool is_rgb() const { return options.bands == Bands::rgb; }
  std::size_t chunk_rows() const { return std::min(options.chunk_intervals, bounds.size()); }
  ChunkShape chunk_shape(std::size_t columns) const {
    return {chunk_rows(), std::min(patches_per_chunk, columns)};
  }

  void create_dimension(const std::string& name, std::size_t size) {
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

  /// A dataset with the attributes of the schema; `dims` may differ from it.
  h5::Dataset create(const ResultVariable& of, const std::vector<std::string>& dims) {
    h5::DatasetSpec spec{of.type, {}, {}, options.compression};
    for (const auto& dim : dims) spec.shape.push_back(sizes.at(dim));
    const bool is_floating = of.type == h5::Type::float32 || of.type == h5::Type::float64;
    const bool is_fillable = is_floating && of.part != ResultPart::coordinate;
    if (is_fillable) spec.unwritten = h5::DatasetSpec::Unwritten::nan;
    if (of.part == ResultPart::series && spec.shape.front() > 0 && spec.shape.back() > 0) {
      const ChunkShape shape = chunk_shape(spec.shape.back());
      spec.chunk.assign(spec.shape.size(), 1);
      spec.chunk.front() = shape.rows;
      spec.chunk.back() = shape.columns;
    }
    h5::Dataset dataset = file->create_dataset(std::string(of.name), spec);
    if (of.name == "time" || of.name == "band") {
      dataset.make_scale(std::string(of.name));
      scales.emplace(std::string(of.name), dataset);
    } else {
      for (std::size_t i = 0; i < dims.size(); ++i) dataset.attach_scale(i, scales.at(dims[i]));
    }
    if (is_fillable) dataset.set("_FillValue", {std::nan("")}, of.type);
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

  std::vector<std::string> dimensions_of(const ResultVariable& of) const {
    const auto names = dimension_names(of);
    return is_rgb() && has_bands(of) ? with_band(names) : names;
  }

  h5::Dataset create(const std::string& name) {
    return create(variable(name), dimensions_of(variable(name)));
  }

  template <class Value>
  h5::Dataset put(const std::string& name, const std::vector<Value>& values) {
    h5::Dataset dataset = create(name);
    dataset.write(values);
    return dataset;
  }

  void put_dimensions(const ResultGeometry& geometry);
  void put_times(const ResultTimes& times);
  void put_vertices(const ResultGeometry& geometry);
  void put_mesh_topology();
  void put_patches(const ResultGeometry& geometry);
  void put_groups(const ResultGeometry& geometry);
  void put_sensors(const ResultGeometry& geometry);
  void put_bands();
  h5::Dataset series_dataset(const std::string& name);
  void append_series(const BatchReader& batch, const ArraySpec& spec);
  void append_ledger(const BatchReader& batch, const ArraySpec& spec);
  void put_time_sums();
  void put_attributes(const ResultAttributes& attributes);
};

void ResultWriter::File::put_dimensions(const ResultGeometry& geometry) {
  constexpr std::size_t corners = 3, coordinates = 3, ends = 2;
  create_dimension("bounds", ends);
  create_dimension("xyz", coordinates);
  create_dimension("corner", corners);
  create_dimension("vertex", geometry.vertices.size());
  create_dimension("patch", geometry.patch_vertices.size());
  create_dimension("input_triangle", geometry.input_triangle_vertices.size());
  create_dimension("object", geometry.object_name.size());
  create_dimension("facade", geometry.facade_name.size());
  create_dimension("material", geometry.material_name.size());
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
  put("time_bounds", flat(times.bounds));
  put("sun_azimuth", times.sun_azimuth_deg);
  put("sun_elevation", times.sun_elevation_deg);
  put("sun_direction", flat(times.sun_direction));
  put("dni", times.dni);
  put("dhi", times.dhi);
  put("ghi", times.ghi);
  if (options.quantity != Quantity::illuminance) return;
  put("direct_normal_illuminance", times.direct_illuminance);
  put("diffuse_horizontal_illuminance", times.diffuse_illuminance);
  put("global_horizontal_illuminance", times.global_illuminance);
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

/// The dataset that arrays of the batches go to, made when first met.
h5::Dataset ResultWriter::File::series_dataset(const std::string& name) {
  if (file->has(stored(name))) return file->dataset(stored(name));
  ResultVariable of = variable(name);
  SUNLOAD_EXPECT(of.part == ResultPart::series || of.part == ResultPart::ledger,
                 "batches do not bring " + name);
  if (of.part == ResultPart::series) return create(name);
  if (!is_standard_error(name)) return create(name);
  const std::string long_name = "standard error of " + name.substr(0, name.rfind("_se"));
  // Per instant; the scalar of the schema is of the time sum.
  const std::string units = light_units("W", options.quantity);
  of.units = units;
  of.long_name = long_name;
  return create(of, is_rgb() ? with_band({"time"}) : std::vector<std::string>{"time"});
}

/// A [time, n] array: one row of chunks, copied where the batch has them.
void ResultWriter::File::append_series(const BatchReader& batch, const ArraySpec& spec) {
  const BandArray array = band_array(spec.name);
  h5::Dataset dataset = series_dataset(array.name);
  SUNLOAD_EXPECT(spec.dims.size() == 2 && spec.dims[1] == dataset.shape().back(),
                 "size of series " + spec.name);
  const std::size_t columns = spec.dims[1];
  if (columns == 0) return;
  const ChunkShape shape = chunk_shape(columns);
  const auto put_chunk = [&](std::size_t c, std::span<const unsigned char> bytes) {
    const bool is_plain = bytes.size() == shape.bytes();
    std::vector<std::size_t> offset{batch.header().first_interval};
    if (array.band) offset.push_back(*array.band);
    offset.push_back(c * shape.columns);
    dataset.write_chunk(offset, bytes, is_plain ? h5::ChunkCoding::plain
                                                : h5::ChunkCoding::deflated);
  };
  if (batch.chunk_count(spec.name) > 0) {
    SUNLOAD_EXPECT(batch.chunk_count(spec.name) == shape.count(columns), "chunks of " + spec.name);
    for (std::size_t c = 0; c < shape.count(columns); ++c) {
      const auto chunk = batch.chunk(spec.name, c);
      put_chunk(c, {chunk.data, chunk.bytes});
    }
  } else {
    const auto values = batch.doubles(spec.name);
    const std::vector<float> narrowed(values.begin(), values.end());
    const auto chunks =
        encoded_chunks(narrowed.data(), spec.dims[0], columns, shape, options.compression);
    for (std::size_t c = 0; c < chunks.size(); ++c) put_chunk(c, chunks[c]);
  }
}

/// A [time] array: ledger terms, or their standard errors per instant. Those of all bands come
/// with the first of them.
void ResultWriter::File::append_ledger(const BatchReader& batch, const ArraySpec& spec) {
  SUNLOAD_EXPECT(spec.dims.size() == 1, "ledger term " + spec.name + " has one value per interval");
  const BandArray array = band_array(spec.name);
  if (array.band.value_or(0) != 0) return;
  std::vector<std::vector<double>> bands;
  for (const auto& prefix : band_prefixes(options.bands))
    bands.push_back(batch.doubles(prefix + array.name));
  series_dataset(array.name)
      .write_rows(batch.header().first_interval, spec.dims[0],
                  side_by_side(std::move(bands), spec.dims[0]).data());
}

/// Sums of the ledger's rows that are there, and their standard errors.
void ResultWriter::File::put_time_sums() {
  for (const auto& term : result_schema()) {
    const std::string name(term.name), se_name = name + "_se";
    if (term.part != ResultPart::ledger || is_standard_error(name)) continue;
    const auto se = time_sum_se_kwh.find(se_name);
    if (se != time_sum_se_kwh.end() && !file->has(se_name)) put(se_name, se->second);
    if (!file->has(name)) continue;
    h5::Dataset dataset = file->dataset(name);
    const std::vector<double> power = dataset.doubles();
    std::vector<double> energy(is_rgb() ? band_count : 1, 0);  // kWh; of all bands
    for (std::size_t i = 0; i < power.size(); ++i) {
      const std::size_t t = i / energy.size();
      // lm s in klm h is what J is in kWh.
      if (!std::isnan(power[i])) energy[i % energy.size()] += power[i] * (bounds[t][1] - bounds[t][0]);
    }
    for (auto& of_band : energy) of_band /= joules_per_kwh;
    set_values(dataset, unit_names("time_sum_kwh", options.quantity), energy);
    if (se != time_sum_se_kwh.end()) {
      set_values(dataset, unit_names("time_sum_se_kwh", options.quantity), se->second);
    }
  }
}

void ResultWriter::File::put_attributes(const ResultAttributes& attributes) {
  for (const auto& [name, value] : attributes.text) file->set(name, value);
  for (const auto& [name, value] : attributes.numbers) file->set(name, value, h5::Type::float64);
  for (const auto& [name, value] : attributes.integers) file->set(name, value);
  file->set("Conventions", std::string(result_conventions));
  file->set("sunload_format", std::string(result_format));
  if (options.quantity == Quantity::illuminance) file->set("quantity", "illuminance");
  if (options.times_are_synthetic) file->set("time_is_synthetic", std::int64_t{1});
  const auto id = std::find_if(attributes.text.begin(), attributes.text.end(),
                               [](const auto& text) { return text.first == "pairing_id"; });
  if (id == attributes.text.end()) return;
  for (const char* name : {"light_load_realization", "facade_light_load_realization",
                           "sensor_light_load_realization"}) {
    if (file->has(name)) file->dataset(name).set("pairing_id", id->second);
  }
}

ResultWriter::ResultWriter(const std::string& path, const ResultGeometry& geometry,
                           const ResultTimes& times, const Options& options)
    : file_(std::make_unique<File>(path, options)) {
  SUNLOAD_EXPECT(options.chunk_intervals > 0 && !times.time.empty(), "intervals of a result");
  SUNLOAD_EXPECT(times.bounds.size() == times.time.size(), "bounds of the intervals");
  file_->writing([&] {
    file_->file.emplace(h5::File::create(file_->target.aside()));
    file_->put_dimensions(geometry);
    file_->put_times(times);
    file_->put_bands();
    file_->put_mesh_topology();
    file_->put_vertices(geometry);
    file_->put_patches(geometry);
    file_->put_groups(geometry);
    file_->put_sensors(geometry);
  });
}

ResultWriter::~ResultWriter() = default;

void ResultWriter::append(const BatchReader& batch) {
  const BatchHeader& header = batch.header();
  const std::size_t intervals = file_->bounds.size();
  SUNLOAD_EXPECT(header.chunk_intervals == file_->options.chunk_intervals &&
                     header.batch < file_->appended.size() &&
                     header.first_interval == header.batch * header.chunk_intervals &&
                     header.interval_count ==
                         std::min(header.chunk_intervals, intervals - header.first_interval),
                 "rows of batch " + std::to_string(header.batch));
  SUNLOAD_EXPECT(!file_->appended[header.batch], "each batch is appended once");
  file_->appended[header.batch] = 1;
  std::vector<ArraySpec> specs;
  for (const ArraySpec& spec : batch.arrays()) {
    const auto& left_out = file_->options.left_out;
    const bool is_wanted =
        std::find(left_out.begin(), left_out.end(), band_array(spec.name).name) == left_out.end();
    // Sums and maxima are put together by the caller.
    if (spec.rule == MergeRule::append && is_wanted) specs.push_back(spec);
  }
  file_->writing([&] {
    // All datasets before all data: their text is then outside of the series' bytes.
    for (const ArraySpec& spec : specs) file_->series_dataset(band_array(spec.name).name);
    if (file_->series.begin == 0) file_->series.begin = file_->file->end();
    for (const ArraySpec& spec : specs) {
      if (file_->variable(band_array(spec.name).name).part == ResultPart::series) {
        file_->append_series(batch, spec);
      } else {
        file_->append_ledger(batch, spec);
      }
    }
    file_->series.end = file_->file->end();
    file_->target.start_flushing();
  });
}

void ResultWriter::write(const ResultArray& array) {
  const ResultVariable& variable = file_->variable(array.name);
  if (variable.part == ResultPart::ledger && is_standard_error(array.name)) {
    SUNLOAD_EXPECT(array.values.size() == (file_->is_rgb() ? band_count : 1),
                   array.name + " is one value, or one of each band");
    file_->time_sum_se_kwh[array.name] = array.values;
    return;
  }
  SUNLOAD_EXPECT(variable.part == ResultPart::total, array.name + " is no total");
  file_->writing([&] { file_->put(array.name, array.values); });
}

void ResultWriter::finish(const ResultAttributes& attributes, const std::string& study_yaml) {
  file_->writing([&] {
    file_->put_time_sums();
    file_->put("study_yaml", std::vector{study_yaml});
    file_->put_attributes(attributes);
    file_->scales.clear();
    file_->file->close();
    file_->file.reset();
    seal_result(file_->target.aside(), file_->series);
  });
  file_->target.publish();
}

}  // namespace sunload
