// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/result/writer.h"

#include <algorithm>
#include <cmath>

#include "geo/base/units.h"
#include "io/base/bands.h"
#include "io/result/datasets.h"

namespace sunload {
namespace {

/// One number, or one per band.
void set_values(h5::Dataset& dataset, const std::string& attribute,
                const std::vector<double>& values) {
  if (values.size() == 1)
    dataset.set(attribute, values.front(), h5::Type::float64);
  else
    dataset.set(attribute, values, h5::Type::float64);
}

/// Ledger terms end without it, their standard errors with it.
bool is_standard_error(std::string_view name) { return name.ends_with("_se"); }

}  // namespace

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

/// Makes the dataset that an array goes to, and says how its values are rounded.
void ResultWriter::File::make_series(const ArraySpec& spec) {
  // The word by which netCDF-4 knows it: bits kept of the mantissa.
  constexpr const char* bits_kept = "_QuantizeBitRoundNumberOfSignificantBits";
  const std::string name = band_array(spec.name).name;
  const bool is_new = !file->has(stored(name));
  h5::Dataset dataset = series_dataset(name);
  if (is_new && spec.mantissa_bits < all_mantissa_bits)
    dataset.set(bits_kept, spec.mantissa_bits, h5::Type::int32);
  const auto bits = is_new ? std::nullopt : dataset.numbers(bits_kept);
  SUNLOAD_EXPECT(is_new || (bits ? bits->front() : all_mantissa_bits) == spec.mantissa_bits,
                 "bits of series " + spec.name);
}

void ResultWriter::File::write_chunk(const std::string& array, std::size_t first, std::size_t chunk,
                                     std::span<const unsigned char> bytes) {
  const BandArray of = band_array(array);
  h5::Dataset dataset = series_dataset(of.name);
  const ChunkShape shape = chunk_shape(dataset.shape().back());
  const bool is_plain = bytes.size() == shape.bytes();
  std::vector<std::size_t> offset{first};
  if (of.band) offset.push_back(*of.band);
  offset.push_back(chunk * shape.columns);
  if (is_plain) {  // what is stored as it is has a checksum all the same
    constexpr int stored_level = 0;
    dataset.write_chunk(offset, zlib_deflated(bytes, stored_level),
                        h5::ChunkCoding::deflated_unshuffled);
  } else {
    dataset.write_chunk(offset, bytes, h5::ChunkCoding::deflated);
  }
}

void ResultWriter::File::write_values(const std::string& array, std::size_t first,
                                      const std::vector<float>& values, std::size_t columns,
                                      int mantissa_bits) {
  const auto chunks = encoded_chunks(values.data(), values.size() / columns, columns,
                                     chunk_shape(columns), options.compression, mantissa_bits);
  for (std::size_t c = 0; c < chunks.size(); ++c) write_chunk(array, first, c, chunks[c]);
}

/// A [time, n] array: one row of chunks, copied where the batch has them.
void ResultWriter::File::append_series(const BatchReader& batch, const ArraySpec& spec) {
  const std::size_t columns = spec.dims.size() == 2 ? spec.dims[1] : 0;
  SUNLOAD_EXPECT(
      spec.dims.size() == 2 && columns == series_dataset(band_array(spec.name).name).shape().back(),
      "size of series " + spec.name);
  if (columns == 0) return;
  const std::size_t first = batch.header().first_interval, chunks = batch.chunk_count(spec.name);
  SUNLOAD_EXPECT(chunks == 0 || chunks == chunk_shape(columns).count(columns),
                 "chunks of " + spec.name);
  for (std::size_t c = 0; c < chunks; ++c) {
    const auto chunk = batch.chunk(spec.name, c);
    write_chunk(spec.name, first, c, {chunk.data, chunk.bytes});
  }
  if (chunks > 0) return;
  const auto values = batch.doubles(spec.name);
  write_values(spec.name, first, {values.begin(), values.end()}, columns, all_mantissa_bits);
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
      if (!std::isnan(power[i]))
        energy[i % energy.size()] += power[i] * (bounds[t][1] - bounds[t][0]);
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
  if (!options.series_step.empty()) file->set("series_step", options.series_step);
  const auto id = std::find_if(attributes.text.begin(), attributes.text.end(),
                               [](const auto& text) { return text.first == "pairing_id"; });
  if (id == attributes.text.end()) return;
  for (const char* name : {"light_load_realization", "facade_light_load_realization",
                           "selection_light_load_realization", "sensor_light_load_realization"}) {
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
    file_->put_divisions(geometry);
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
    for (const ArraySpec& spec : specs) file_->make_series(spec);
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

void ResultWriter::append(const StepRows& rows) {
  SUNLOAD_EXPECT(rows.first % file_->chunk_rows() == 0 && rows.count <= file_->chunk_rows(),
                 "rows of steps are a row of chunks");
  file_->writing([&] {
    for (const auto& of : rows.series)
      file_->make_series({of.name, MergeRule::append, ArrayType::float32, {}, of.mantissa_bits});
    for (const auto& of : rows.ledger) file_->series_dataset(band_array(of.name).name);
    if (file_->series.begin == 0) file_->series.begin = file_->file->end();
    for (const auto& of : rows.series)
      if (of.columns > 0)
        file_->write_values(of.name, rows.first, of.values, of.columns, of.mantissa_bits);
    const auto prefixes = band_prefixes(file_->options.bands);
    for (const auto& of : rows.ledger) {
      const BandArray array = band_array(of.name);
      if (array.band.value_or(0) != 0) continue;
      std::vector<std::vector<double>> bands;
      bands.reserve(prefixes.size());
      for (const auto& prefix : prefixes)
        bands.push_back(
            std::find_if(rows.ledger.begin(), rows.ledger.end(), [&](const auto& other) {
              return other.name == prefix + array.name;
            })->values);
      file_->series_dataset(array.name)
          .write_rows(rows.first, rows.count, side_by_side(std::move(bands), rows.count).data());
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

void ResultWriter::write_measure(const MeasureArray& array, const MeasureAttributes& attributes) {
  ResultVariable of = *find_result_variable(array.name);
  of.name = array.name;
  of.units = array.units;
  if (!array.texts.empty()) of.type = h5::Type::text;
  file_->writing([&] {
    h5::Dataset dataset = file_->create(of, dimension_names(of));
    array.texts.empty() ? dataset.write(array.values) : dataset.write(array.texts);
    for (const auto& [name, value] : attributes.text) dataset.set(name, value);
    if (attributes.level_values.empty()) return;
    dataset.set("level_values", attributes.level_values, h5::Type::float64);
    dataset.set("area_percent", attributes.area_percent, h5::Type::float64);
  });
}

void ResultWriter::write_part(const ResultArray& array, std::size_t part) {
  file_->writing([&] {
    h5::Dataset dataset = file_->file->dataset(file_->stored(array.name));
    dataset.write_rows(part, 1, array.values.data());
  });
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
