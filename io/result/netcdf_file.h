// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// A file of tables with named dimensions that netCDF-4 tools read, besides the result itself:
/// comparisons, form factors.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "io/result/h5.h"
#include "io/result/reader.h"

namespace sunload {

class NetcdfFile {
 public:
  /// `path` must not exist yet. Throws h5::Error, as all that follows.
  explicit NetcdfFile(const std::string& path) : file_(h5::File::create(path)) {}

  /// A dimension without labels.
  void dimension(const std::string& name, std::size_t size);
  /// A dimension whose entries have names.
  void labels(const std::string& name, const std::string& long_name,
              const std::vector<std::string>& names);
  /// A dimension whose entries are numbered from 0.
  void numbers(const std::string& name, const std::string& long_name, std::size_t size);

  /// Over dimensions that are there already; `units` may be empty.
  template <class Value>
  h5::Dataset put(const std::string& name, const std::vector<std::string>& dims, h5::Type type,
                  const std::string& units, const std::string& long_name,
                  const std::vector<Value>& values) {
    h5::DatasetSpec spec{type, {}, {}, 0};
    for (const auto& dim : dims) spec.shape.push_back(sizes_.at(dim));
    auto dataset = file_.create_dataset(name, spec);
    for (std::size_t i = 0; i < dims.size(); ++i) dataset.attach_scale(i, scales_.at(dims[i]));
    if (type == h5::Type::float64)
      dataset.set("_FillValue", std::numeric_limits<double>::quiet_NaN(), type);
    dataset.set("long_name", long_name);
    if (!units.empty()) dataset.set("units", units);
    dataset.write(values);
    return dataset;
  }

  /// Attributes of the whole.
  h5::File& file() { return file_; }
  void close();

 private:
  void make_scale(const std::string& name, const std::string& long_name, h5::Dataset scale);

  h5::File file_;
  std::map<std::string, std::size_t> sizes_;
  std::map<std::string, h5::Dataset> scales_;
};

/// Writes such a file, whole or not at all: `put` fills it. Throws MachineError.
void write_netcdf(const std::string& path, const std::function<void(NetcdfFile&)>& put);

/// The patches of a result with their places, names and kinds, as its own file has them.
void put_mesh(NetcdfFile& file, const ResultReader& of);
/// A dataset [patch] of the mesh: its attributes are those of UGRID.
void put_of_patches(NetcdfFile& file, const std::string& name, const std::string& units,
                    const std::string& long_name, const std::vector<double>& values);
/// Attributes of the root: study, place on Earth, origin of the coordinates, period in words.
void put_site(h5::File& file, const ResultReader& of);

}  // namespace sunload
