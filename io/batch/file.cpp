// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/batch/file.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "geo/base/check.h"
#include "io/batch/chunk.h"
#include "io/batch/container.h"
#include "solver/base/threads.h"

namespace sunload {
namespace {

using nlohmann::json;

constexpr std::array<const char*, 4> rule_names{"append", "sum", "maximum", "step"};
constexpr std::array<const char*, 2> type_names{"float32", "float64"};

template <class Enum, std::size_t n>
Enum from_name(const std::string& name, const std::array<const char*, n>& names) {
  for (std::size_t i = 0; i < n; ++i) {
    if (name == names[i]) return static_cast<Enum>(i);
  }
  throw std::runtime_error("unknown word " + name);
}

template <class Enum, std::size_t n>
const char* name_of(Enum value, const std::array<const char*, n>& names) {
  // cppcheck-suppress CastIntegerToAddressAtReturn  // an index
  return names[static_cast<std::size_t>(value)];
}

std::size_t value_bytes(ArrayType type) {
  return type == ArrayType::float32 ? sizeof(float) : sizeof(double);
}

std::size_t value_count(const ArraySpec& spec) {
  constexpr std::size_t most = std::size_t{1} << 48;  // no machine has them; sums do not overflow
  std::size_t count = 1;
  for (const std::size_t size : spec.dims) {
    if (__builtin_mul_overflow(count, size, &count) || size > most || count > most)
      throw std::runtime_error("array too large");
  }
  return count;
}

bool is_chunked(const ArraySpec& spec) {
  return spec.type == ArrayType::float32 && spec.rule == MergeRule::append &&
         spec.dims.size() == 2 && spec.dims[1] > 0;
}

/// Of the chunks of a [time, n] array in batch and result. A first batch that
/// is shorter than others is the only one: chunks need not be longer than it.
ChunkShape chunk_shape(const BatchHeader& header, const ArraySpec& spec) {
  const std::size_t rows = header.batch == 0
                               ? std::min(header.interval_count, header.chunk_intervals)
                               : header.chunk_intervals;
  return {rows, std::min(patches_per_chunk, spec.dims[1])};
}

json to_json(const BatchHeader& header) {
  return {{"content_hash", header.content_hash},
          {"variant", header.variant},
          {"isa", header.isa},
          {"batch", header.batch},
          {"first_interval", header.first_interval},
          {"interval_count", header.interval_count},
          {"chunk_intervals", header.chunk_intervals},
          {"compression", header.compression},
          {"left_out", header.left_out}};
}

BatchHeader header_from(const json& from) {
  BatchHeader header;
  from.at("content_hash").get_to(header.content_hash);
  from.at("variant").get_to(header.variant);
  from.at("isa").get_to(header.isa);
  from.at("batch").get_to(header.batch);
  from.at("first_interval").get_to(header.first_interval);
  from.at("interval_count").get_to(header.interval_count);
  from.at("chunk_intervals").get_to(header.chunk_intervals);
  from.at("compression").get_to(header.compression);
  header.left_out = from.value("left_out", header.left_out);
  return header;
}

ArraySpec spec_from(const json& from) {
  ArraySpec spec{from.at("name"), from_name<MergeRule>(from.at("rule"), rule_names),
                 from_name<ArrayType>(from.at("type"), type_names), from.at("dims"),
                 from.value("mantissa_bits", all_mantissa_bits)};
  if (spec.mantissa_bits < 1 || spec.mantissa_bits > all_mantissa_bits)
    throw std::runtime_error("bits of array " + spec.name);
  return spec;
}

}  // namespace

/// An array as it lies in the file: plain values, or chunks one after another.
struct BatchWriter::Block {
  ArraySpec spec;
  std::vector<double> doubles;  ///< or
  Bytes plain;                  ///< or
  std::vector<Bytes> chunks;

  std::vector<std::size_t> chunk_bytes() const {
    std::vector<std::size_t> lengths;
    for (const auto& chunk : chunks) lengths.push_back(chunk.size());
    return lengths;
  }
  BlockPieces pieces() const {
    if (!doubles.empty())
      return {{reinterpret_cast<const unsigned char*>(doubles.data()),
               doubles.size() * sizeof(double)}};
    return chunks.empty() ? BlockPieces{plain} : BlockPieces(chunks.begin(), chunks.end());
  }
};

BatchWriter::BatchWriter(BatchHeader header) : header_(std::move(header)) {
  SUNLOAD_EXPECT(header_.interval_count > 0 && header_.interval_count <= header_.chunk_intervals,
                 "a batch is one row of chunks");
}

std::shared_ptr<BatchWriter::Block> BatchWriter::new_block(const ArraySpec& spec, ArrayType type) {
  SUNLOAD_EXPECT(spec.type == type, "type of array " + spec.name);
  SUNLOAD_EXPECT(spec.rule != MergeRule::append ||
                     (!spec.dims.empty() && spec.dims[0] == header_.interval_count),
                 "array " + spec.name + " has one row per interval");
  for (const auto& block : blocks_) {
    SUNLOAD_EXPECT(block->spec.name != spec.name, "array " + spec.name + " is added once");
  }
  auto block = std::make_shared<Block>();
  block->spec = spec;
  blocks_.push_back(block);
  return block;
}

void BatchWriter::add(const ArraySpec& spec, const double* values) {
  add(spec, std::vector<double>(values, values + value_count(spec)));
}

void BatchWriter::add(const ArraySpec& spec, std::vector<double>&& values) {
  SUNLOAD_EXPECT(values.size() == value_count(spec), "array " + spec.name + " has all its values");
  new_block(spec, ArrayType::float64)->doubles = std::move(values);
}

void BatchWriter::add(const ArraySpec& spec, const float* values) {
  const auto block = new_block(spec, ArrayType::float32);
  if (!is_chunked(spec)) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(values);
    block->plain.assign(bytes, bytes + value_count(spec) * sizeof(float));
    return;
  }
  block->chunks = encoded_chunks(values, spec.dims[0], spec.dims[1], chunk_shape(header_, spec),
                                 header_.compression, spec.mantissa_bits);
}

void BatchWriter::write(const std::string& path) const {
  json tables = json::array();
  std::vector<BlockPieces> blocks;
  for (const auto& block : blocks_) {
    tables.push_back({{"name", block->spec.name},
                      {"rule", name_of(block->spec.rule, rule_names)},
                      {"type", name_of(block->spec.type, type_names)},
                      {"dims", block->spec.dims},
                      {"chunk_bytes", block->chunk_bytes()}});
    if (!block->chunks.empty() || block->spec.rule == MergeRule::step)
      tables.back()["mantissa_bits"] = block->spec.mantissa_bits;
    blocks.push_back(block->pieces());
  }
  write_container(path, {{"batch", to_json(header_)}, {"arrays", tables}}, blocks);
}

struct BatchReader::Content {
  explicit Content(const std::string& path) : container(path) {}
  Container container;
  struct Array {
    std::vector<std::size_t> chunk_begin;  ///< bytes within the block; empty: plain values
    Bytes bytes;                           ///< read when first asked for
  };
  std::vector<Array> arrays;
};

namespace {

/// Deflate packs no more than 1032 bytes into one (zlib's technical details).
constexpr std::size_t most_packed = 1032;

/// Where each chunk begins, and the end of the last; checks the block's length.
std::vector<std::size_t> chunk_begins(const std::vector<std::size_t>& lengths,
                                      const BatchHeader& header, const ArraySpec& spec,
                                      std::size_t block_bytes) {
  const ChunkShape shape = chunk_shape(header, spec);
  if (lengths.size() != shape.count(spec.dims[1])) throw std::runtime_error("number of chunks");
  std::vector<std::size_t> begins{0};
  for (const std::size_t length : lengths) {
    // Before a chunk that says it is large asks for memory.
    if (length == 0 || length > shape.bytes() || shape.bytes() / most_packed > length)
      throw std::runtime_error("length of a chunk");
    begins.push_back(begins.back() + length);
  }
  if (begins.back() != block_bytes) throw std::runtime_error("length of the chunks");
  return begins;
}

}  // namespace

BatchReader::BatchReader(const std::string& path) : content_(std::make_unique<Content>(path)) {
  const Container& container = content_->container;
  try {
    header_ = header_from(container.header().at("batch"));
    constexpr std::size_t most_intervals = 1 << 20;  // studies have 65536
    if (header_.interval_count == 0 || header_.interval_count > header_.chunk_intervals ||
        header_.chunk_intervals > most_intervals) {
      throw std::runtime_error("number of intervals");
    }
    const json& tables = container.header().at("arrays");
    if (tables.size() != container.block_count()) throw std::runtime_error("number of arrays");
    for (std::size_t i = 0; i < tables.size(); ++i) {
      const json& table = tables[i];
      ArraySpec spec = spec_from(table);
      if (spec.rule == MergeRule::append &&
          (spec.dims.empty() || spec.dims[0] != header_.interval_count)) {
        throw std::runtime_error("rows of array " + spec.name);
      }
      Content::Array array;
      const std::size_t values = value_count(spec);
      if (is_chunked(spec)) {
        array.chunk_begin =
            chunk_begins(table.at("chunk_bytes"), header_, spec, container.block_bytes(i));
      } else if (values != container.block_bytes(i) / value_bytes(spec.type) ||
                 container.block_bytes(i) % value_bytes(spec.type) != 0) {
        throw std::runtime_error("length of array " + spec.name);
      }
      specs_.push_back(std::move(spec));
      content_->arrays.push_back(std::move(array));
    }
  } catch (const std::runtime_error& error) {
    container.refuse(error.what());
  } catch (const json::exception& error) {
    container.refuse(error.what());
  }
}

BatchReader::~BatchReader() = default;
BatchReader::BatchReader(BatchReader&&) noexcept = default;

const std::string& BatchReader::path() const { return content_->container.path(); }

void BatchReader::verify() const { content_->container.verify(); }

bool BatchReader::has(const std::string& name) const {
  return std::any_of(specs_.begin(), specs_.end(), [&](const auto& s) { return s.name == name; });
}

std::size_t BatchReader::index(const std::string& name) const {
  for (std::size_t i = 0; i < specs_.size(); ++i) {
    if (specs_[i].name == name) return i;
  }
  content_->container.refuse("it has no array " + name);
}

const ArraySpec& BatchReader::spec(const std::string& name) const { return specs_[index(name)]; }

std::span<const unsigned char> BatchReader::block(const std::string& name) const {
  const std::size_t i = index(name);
  auto& array = content_->arrays[i];
  if (array.bytes.empty()) array.bytes = content_->container.block(i);
  return array.bytes;
}

std::vector<double> BatchReader::doubles(const std::string& name) const {
  if (spec(name).type == ArrayType::float32) {
    const auto values = floats(name);
    return {values.begin(), values.end()};
  }
  const auto bytes = block(name);
  std::vector<double> values(bytes.size() / sizeof(double));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

std::vector<float> BatchReader::floats(const std::string& name) const {
  const ArraySpec& array = spec(name);
  SUNLOAD_EXPECT(array.type == ArrayType::float32, "type of array " + name);
  std::vector<float> values(value_count(array));
  if (!is_chunked(array)) {
    const auto bytes = block(name);
    if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }
  const std::size_t columns = array.dims[1];
  const ChunkShape shape = chunk_shape(header_, array);
  block(name);  // read before the threads ask for its chunks
  parallel_for(chunk_count(name), [&](std::size_t c) {
    const Chunk coded = chunk(name, c);
    std::vector<float> part;
    try {
      part = decoded_chunk({coded.data, coded.bytes}, shape);
    } catch (const std::runtime_error& error) {
      content_->container.refuse(error.what());
    }
    const std::size_t first = c * shape.columns;
    const std::size_t width = std::min(shape.columns, columns - first);
    for (std::size_t row = 0; row < array.dims[0]; ++row) {
      std::copy_n(part.data() + row * shape.columns, width, values.data() + row * columns + first);
    }
  });
  return values;
}

std::size_t BatchReader::chunk_count(const std::string& name) const {
  const auto& begins = content_->arrays[index(name)].chunk_begin;
  return begins.empty() ? 0 : begins.size() - 1;
}

BatchReader::Chunk BatchReader::chunk(const std::string& name, std::size_t c) const {
  SUNLOAD_EXPECT(c < chunk_count(name), "chunk of array " + name);
  const auto& begins = content_->arrays[index(name)].chunk_begin;
  const auto bytes = block(name).subspan(begins[c], begins[c + 1] - begins[c]);
  const bool is_plain = bytes.size() == chunk_shape(header_, spec(name)).bytes();
  return {bytes.data(), bytes.size(), is_plain};
}

void expect_series(const BatchReader& batch, const std::vector<std::string>& may_lack) {
  for (const auto& name : batch.header().left_out)
    if (std::find(may_lack.begin(), may_lack.end(), name) == may_lack.end())
      throw InputError({batch.path()}, "has no series " + name,
                       "it was computed for other output.series", "compute it again");
}

BatchCheck check_batch(const std::string& path, const std::string& content_hash, std::size_t batch,
                       const std::vector<std::string>& may_lack) {
  BatchCheck check;
  std::error_code error;
  check.exists = std::filesystem::exists(path, error);
  if (!check.exists) return check;
  try {
    const BatchReader reader(path);
    expect_series(reader, may_lack);
    reader.verify();
    const BatchHeader& header = reader.header();
    if (header.content_hash != content_hash) {
      check.reason = path + ": is of another study, hash " + header.content_hash;
    } else if (header.batch != batch) {
      check.reason = path + ": is batch " + std::to_string(header.batch);
    }
  } catch (const InputError& problem) {
    check.reason = problem.what();
  }
  check.valid = check.reason.empty();
  return check;
}

}  // namespace sunload
