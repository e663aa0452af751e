// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// HDF5 behind values and exceptions: the only file that knows the library.
///
/// One flat group of datasets with attributes and dimension scales, as netCDF-4
/// tools read it. Objects bear no times, so that equal runs give equal files.
/// Text is variable-length UTF-8 throughout. Not to be used by several threads
/// at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace sunload::h5 {

/// What HDF5 says went wrong; the caller adds the file's name.
class Error : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// An identifier of the library, released with its last owner.
using Handle = std::shared_ptr<const std::int64_t>;

/// How values are stored.
enum class Type : std::uint8_t { int8, int32, int64, float32, float64, text };

/// What the values of a dataset are, whatever their width; text is of variable length.
enum class ValueKind : std::uint8_t { integer, real, text, other };
std::string_view kind_words(ValueKind kind);  ///< "whole numbers"

/// Attributes of a dataset or of the root group.
class Object {
 public:
  void set(const std::string& attribute, const std::string& text);
  void set(const std::string& attribute, const std::vector<double>& values, Type type);
  void set(const std::string& attribute, double value, Type type);
  void set(const std::string& attribute, std::int64_t value);
  std::optional<std::string> text(const std::string& attribute) const;
  /// Values of a numeric attribute; none if it is absent or not numeric.
  std::optional<std::vector<double>> numbers(const std::string& attribute) const;

 protected:
  explicit Object(Handle handle) : handle_(std::move(handle)) {}
  std::int64_t id() const { return *handle_; }
  Handle handle_;
};

/// Whether a chunk comes shuffled and deflated, or its values deflated as they are (which may mean
/// stored beside their checksum).
enum class ChunkCoding : std::uint8_t { deflated, deflated_unshuffled };

/// A dataset of an open file. What fails throws Error; reading converts to the type asked for.
class Dataset : public Object {
 public:
  std::vector<std::size_t> shape() const;
  ValueKind kind() const;
  bool is_text() const { return kind() == ValueKind::text; }

  /// The whole dataset, converted to its type.
  void write(const std::vector<double>& values);
  void write(const std::vector<std::int32_t>& values);
  void write(const std::vector<std::string>& values);
  /// `count` rows from row `first` on.
  void write_rows(std::size_t first, std::size_t count, const double* values);
  /// A finished chunk whose first element is at `offset`.
  void write_chunk(const std::vector<std::size_t>& offset, std::span<const unsigned char> bytes,
                   ChunkCoding coding);

  std::vector<double> doubles() const;
  std::vector<std::int32_t> integers() const;
  std::vector<std::string> strings() const;
  std::vector<double> row(std::size_t index) const;
  std::vector<double> rows(std::size_t first, std::size_t count) const;

  /// Makes this one-dimensional dataset a dimension scale.
  void make_scale(const std::string& name);
  void attach_scale(std::size_t axis, const Dataset& scale);

 private:
  friend class File;
  using Object::Object;
};

/// Type, shape and storage of a new dataset.
struct DatasetSpec {
  Type type = Type::float64;
  std::vector<std::size_t> shape;  ///< empty: a scalar
  std::vector<std::size_t> chunk;  ///< empty: not chunked; else chunks are shuffled and deflated
  int deflate_level = 0;           ///< as declared in the file
  enum class Unwritten {
    zero,
    nan
  } unwritten = Unwritten::zero;  ///< value where nothing is written
};

/// A file with its root group, which the attributes are of. Copies share the open file.
class File : public Object {
 public:
  /// A new file; `path` must not exist yet.
  static File create(const std::string& path);
  File(const File&) = default;
  File(File&&) = default;
  File& operator=(const File&) = default;
  File& operator=(File&&) = default;
  /// The root group goes before the file that it is in.
  ~File() { handle_.reset(); }
  /// An existing file, for reading.
  static File open(const std::string& path);

  Dataset create_dataset(const std::string& name, const DatasetSpec& spec);
  bool has(const std::string& dataset) const;
  /// With `rows` the dataset, while it is kept, holds the chunks that a row lies in (1 GiB at
  /// most): each is inflated once where rows are read one after the other.
  enum class Access { whole, rows };
  Dataset dataset(const std::string& name, Access access = Access::whole) const;
  std::vector<std::string> names() const;
  /// End of the data of HDF5; what lies behind it is none of the library's business.
  std::uint64_t end() const;
  /// Writes out everything and closes; datasets must not be used any more. Throws Error.
  void close();
  /// For a file that failed (disk full): lets go of it without another attempt to
  /// write; its descriptor stays open until the process ends.
  void abandon();

 private:
  File(Handle file, Handle root) : Object(std::move(root)), file_(std::move(file)) {}
  Handle file_;
};

}  // namespace sunload::h5
