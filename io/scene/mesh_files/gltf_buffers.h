// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The numbers of a glTF file: containers, buffers, views, accessors.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "geo/base/vec.h"

namespace sunload {

/// A glTF file taken apart. All accesses are checked against the bytes that are there.
class GltfFile {
 public:
  /// Throws InputError where the file is no glTF 2.0 or its JSON is broken.
  explicit GltfFile(const std::string& path);

  const std::string& path() const { return path_; }
  /// Of the file and of the buffers beside it that were read so far.
  std::size_t bytes() const { return bytes_; }
  /// The buffers beside it that were read so far.
  const std::vector<std::string>& buffer_files() const { return buffer_files_; }
  const nlohmann::json& root() const { return json_; }

  /// Entry `index` of a list such as "nodes"; throws InputError where there is none.
  const nlohmann::json& entry(const std::string& list, const nlohmann::json& index) const;

  /// Points of an accessor of type VEC3.
  std::vector<Vec3> points(const nlohmann::json& accessor);
  /// Quaternions (x, y, z, w) of an accessor of type VEC4.
  std::vector<std::array<double, 4>> quaternions(const nlohmann::json& accessor);
  /// Indices of an accessor of type SCALAR, each below `count`.
  std::vector<std::int32_t> indices(const nlohmann::json& accessor, std::size_t count);

  [[noreturn]] void fail(const std::string& what, const std::string& why = {},
                         const std::string& hint = {}) const;

 private:
  std::vector<double> numbers(const nlohmann::json& accessor, const std::string& type);
  const std::string& buffer(const nlohmann::json& index);
  std::string load_buffer(const nlohmann::json& entry, std::size_t index);
  void take_container_apart(const std::string& bytes);

  std::string path_;
  std::size_t bytes_ = 0;
  nlohmann::json json_;
  std::string binary_chunk_;
  std::vector<std::string> buffers_;
  std::vector<std::string> buffer_files_;
  std::vector<bool> is_loaded_;
};

}  // namespace sunload
