// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Batch files: a finished unit of work (variant, batch) as one valid file.
///
/// A batch is a set of named arrays, each with the rule by which it is put together with those of
/// the batches before and after. Large series arrays are stored in the same chunks (shuffled,
/// deflated) as in the result file, so that merging copies bytes. A file is written under another
/// name, synced to disk, then renamed. See docs/batch-file.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/batch/chunk.h"

namespace sunload {

/// How arrays of consecutive batches become one. append: rows one after another; sum: added;
/// maximum: the larger of two values; step: rows are steps of the series, and a step that goes on
/// in the next batch is the sum of that batch's first row and of the last row before.
enum class MergeRule : std::uint8_t { append, sum, maximum, step };
/// How values are stored.
enum class ArrayType : std::uint8_t { float32, float64 };

/// Shape of the chunks of series in result and batch files.
inline constexpr std::size_t patches_per_chunk = 4096;

/// One array of a batch: its name, shape and rule. A float32 series [time, n] is chunked.
struct ArraySpec {
  std::string name;
  MergeRule rule = MergeRule::append;
  ArrayType type = ArrayType::float64;
  std::vector<std::size_t> dims;  ///< `append`: the first is time within the batch
  /// Bits of the mantissa that a chunked array keeps; of an array by steps, that the result will
  /// keep. Other arrays keep all.
  int mantissa_bits = all_mantissa_bits;
};

/// What a batch is of, and how its arrays are stored.
struct BatchHeader {
  std::string content_hash;  ///< hex SHA-256 of what decides the numbers
  std::string variant;
  std::string isa;        ///< instruction set of the rays
  std::size_t batch = 0;  ///< number within the variant
  std::size_t first_interval = 0, interval_count = 0;
  std::size_t chunk_intervals = 64;  ///< length of a chunk in time (batch_suns)
  int compression = 4;
  /// Series that the study of this batch does not store. A study that stores one of them cannot
  /// merge the batch.
  std::vector<std::string> left_out{};
};

/// Collects arrays (series already compressed) and writes the file in one go.
class BatchWriter {
 public:
  explicit BatchWriter(BatchHeader header);
  void add(const ArraySpec& spec, const double* values);
  /// Moves the values in: large arrays are not in memory twice.
  void add(const ArraySpec& spec, std::vector<double>&& values);
  /// float32 arrays [time, n]: compressed in chunks, in parallel.
  void add(const ArraySpec& spec, const float* values);
  /// Throws MachineError (disk full, not writable); then nothing is left behind.
  void write(const std::string& path) const;

 private:
  struct Block;
  std::shared_ptr<Block> new_block(const ArraySpec& spec, ArrayType type);

  BatchHeader header_;
  std::vector<std::shared_ptr<Block>> blocks_;
};

/// A batch file whose magic, version, length and checksums were verified.
/// Arrays are read and verified when first asked for; not to be shared among threads.
class BatchReader {
 public:
  /// Throws InputError naming the file and what is wrong with its header.
  explicit BatchReader(const std::string& path);
  ~BatchReader();
  BatchReader(BatchReader&&) noexcept;
  /// Reads the whole file. Throws InputError where it is damaged.
  void verify() const;
  const std::string& path() const;
  const BatchHeader& header() const { return header_; }
  const std::vector<ArraySpec>& arrays() const { return specs_; }
  bool has(const std::string& name) const;
  const ArraySpec& spec(const std::string& name) const;
  /// A whole array; one of float32 may be read as doubles too.
  std::vector<double> doubles(const std::string& name) const;
  std::vector<float> floats(const std::string& name) const;  ///< decompressed
  /// Compressed chunk c (patches c·4096 …) of a chunked array, as HDF5 wants it:
  /// always a full chunk, padded with NaN. Valid as long as the reader.
  struct Chunk {
    const unsigned char* data = nullptr;
    std::size_t bytes = 0;
    bool is_plain = false;  ///< stored as it is: neither shuffled nor deflated
  };
  std::size_t chunk_count(const std::string& name) const;  ///< 0: not chunked
  Chunk chunk(const std::string& name, std::size_t c) const;

 private:
  std::size_t index(const std::string& name) const;
  std::span<const unsigned char> block(const std::string& name) const;

  BatchHeader header_;
  std::vector<ArraySpec> specs_;
  struct Content;
  std::unique_ptr<Content> content_;
};

/// Throws InputError where `batch` lacks series other than those of `may_lack`.
void expect_series(const BatchReader& batch, const std::vector<std::string>& may_lack);

/// Whether `path` is a valid batch of that hash and number, without a lack of series other than
/// those of `may_lack`. `reason` tells what is wrong with a file that is there but not valid.
struct BatchCheck {
  bool exists = false, valid = false;
  std::string reason;
};
BatchCheck check_batch(const std::string& path, const std::string& content_hash, std::size_t batch,
                       const std::vector<std::string>& may_lack = {});

}  // namespace sunload
