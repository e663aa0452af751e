// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A result file while it is being written: dimensions and datasets. For result_file.cpp alone.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "geo/base/check.h"
#include "geo/mesh/mesh.h"
#include "io/base/file_aside.h"
#include "io/batch/chunk.h"
#include "io/result/h5.h"
#include "io/result/schema.h"
#include "io/result/seal.h"
#include "io/result/writer.h"

namespace sunload {

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
  ~File();

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

  /// Of the schema; `name` as where it is irradiance.
  const ResultVariable& variable(const std::string& name) const;
  bool is_rgb() const { return options.bands == Bands::rgb; }
  std::size_t chunk_rows() const { return std::min(options.chunk_intervals, bounds.size()); }
  ChunkShape chunk_shape(std::size_t columns) const {
    return {chunk_rows(), std::min(patches_per_chunk, columns)};
  }

  void create_dimension(const std::string& name, std::size_t size);
  /// A dimension whose entries have names.
  void put_labels(const std::string& dimension, const std::vector<std::string>& names);
  /// A dataset with the attributes of the schema; `dims` may differ from it.
  h5::Dataset create(const ResultVariable& of, const std::vector<std::string>& dims);
  std::vector<std::string> dimensions_of(const ResultVariable& of) const;
  h5::Dataset create(const std::string& name) {
    return create(variable(name), dimensions_of(variable(name)));
  }

  template <class Value>
  h5::Dataset put(const std::string& name, const std::vector<Value>& values) {
    h5::Dataset dataset = create(name);
    dataset.write(values);
    return dataset;
  }

  // What is known before the first batch.
  void put_dimensions(const ResultGeometry& geometry);
  void put_times(const ResultTimes& times);
  void put_study_seasons(const ResultTimes& times);
  void put_vertices(const ResultGeometry& geometry);
  void put_mesh_topology();
  void put_patches(const ResultGeometry& geometry);
  void put_groups(const ResultGeometry& geometry);
  void put_sensors(const ResultGeometry& geometry);
  void put_bands();
  /// Dimensions, names and times of divisions, and room for their totals: missing ones are NaN.
  void put_divisions(const ResultGeometry& geometry);
  void put_division(const ResultDivision& division, const ResultGeometry& geometry);

  // What batches bring, and what follows from it (result_file.cpp).
  h5::Dataset series_dataset(const std::string& name);
  void make_series(const ArraySpec& spec);
  void append_series(const BatchReader& batch, const ArraySpec& spec);
  void append_ledger(const BatchReader& batch, const ArraySpec& spec);
  /// One row of chunks of the dataset that an array of that name goes to, from a first row on.
  void write_chunk(const std::string& array, std::size_t first, std::size_t chunk,
                   std::span<const unsigned char> bytes);
  void write_values(const std::string& array, std::size_t first, const std::vector<float>& values,
                    std::size_t columns, int mantissa_bits);
  void put_time_sums();
  void put_attributes(const ResultAttributes& attributes);
};

}  // namespace sunload
