// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/batch/chunk.h"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <stdexcept>

#include "geo/base/check.h"
#include "solver/base/threads.h"

static_assert(std::endian::native == std::endian::little,
              "series are stored as they lie in memory");

namespace sunload {
namespace {

constexpr float fill = std::numeric_limits<float>::quiet_NaN();

/// The filter "shuffle" of HDF5 of `count` values that follow `first` others of a chunk: first byte
/// of all values, second byte of all …
void shuffle(const float* from, std::size_t count, std::size_t first, std::size_t values,
             unsigned char* planes) {
  for (std::size_t plane = 0; plane < sizeof(float); ++plane) {
    unsigned char* to = planes + plane * values + first;
    // Shifts of whole words: compilers turn this loop into packed ones, gathered bytes they do not.
    for (std::size_t i = 0; i < count; ++i)
      to[i] = static_cast<unsigned char>(std::bit_cast<std::uint32_t>(from[i]) >> (8 * plane));
  }
}

void unshuffle(const unsigned char* planes, std::size_t count, unsigned char* values) {
  for (std::size_t i = 0; i < count; ++i) {
    values[4 * i] = planes[i];
    values[4 * i + 1] = planes[count + i];
    values[4 * i + 2] = planes[2 * count + i];
    values[4 * i + 3] = planes[3 * count + i];
  }
}

bool are_mantissa_bits(int bits) { return bits > 0 && bits <= all_mantissa_bits; }

/// To a mantissa of so many bits.
class Rounding {
 public:
  explicit Rounding(int mantissa_bits)
      : left_out_(static_cast<unsigned>(all_mantissa_bits - mantissa_bits)),
        last_kept_(left_out_ > 0 ? 1U : 0U),
        below_half_(left_out_ > 0 ? (1U << (left_out_ - 1)) - 1 : 0U) {}

  bool changes_nothing() const { return left_out_ == 0; }
  float operator()(float value) const {
    constexpr std::uint32_t exponent = 0x7f800000U;
    const auto bits = std::bit_cast<std::uint32_t>(value);
    // Half a unit, less a bit where the last bit kept is even: a carry runs on into the exponent.
    const std::uint32_t nearest =
        (bits + below_half_ + ((bits >> left_out_) & last_kept_)) & (~0U << left_out_);
    return std::bit_cast<float>((bits & exponent) == exponent ? bits : nearest);
  }

 private:
  unsigned left_out_;
  std::uint32_t last_kept_, below_half_;
};

/// Rows of an array and the chunk of them whose first column is `first`.
struct Piece {
  const float* values;
  std::size_t rows, columns, first;
  ChunkShape shape;
  Rounding rounding;

  std::size_t width() const { return std::min(shape.columns, columns - first); }
  std::size_t count() const { return shape.rows * shape.columns; }
  /// Values of row k; `room` has room for them, rounded.
  const float* row(std::size_t k, std::vector<float>& room) const {
    const float* const row = values + k * columns + first;
    if (rounding.changes_nothing()) return row;
    room.resize(width());
    std::transform(row, row + width(), room.begin(), rounding);
    return room.data();
  }
};

/// As it is, padded to its shape.
Bytes plain(const Piece& piece) {
  Bytes bytes(piece.shape.bytes());
  std::vector<float> row(piece.shape.columns, fill), room;
  for (std::size_t k = 0; k < piece.shape.rows; ++k) {
    if (k == piece.rows) std::fill(row.begin(), row.end(), fill);
    if (k < piece.rows) std::copy_n(piece.row(k, room), piece.width(), row.data());
    std::memcpy(bytes.data() + k * row.size() * sizeof(float), row.data(),
                row.size() * sizeof(float));
  }
  return bytes;
}

/// Padded and shuffled; `planes` keeps its memory from chunk to chunk.
void shuffled(const Piece& piece, Bytes& planes) {
  planes.resize(piece.shape.bytes());
  const std::vector<float> padding(piece.shape.columns, fill);
  std::vector<float> room;
  for (std::size_t k = 0; k < piece.shape.rows; ++k) {
    const std::size_t known = k < piece.rows ? piece.width() : 0, first = k * piece.shape.columns;
    if (known > 0) shuffle(piece.row(k, room), known, first, piece.count(), planes.data());
    shuffle(padding.data(), piece.shape.columns - known, first + known, piece.count(),
            planes.data());
  }
}

/// Part of a plane: bytes that are all alike, as of nights and of padding, or others.
struct Stretch {
  std::size_t begin = 0, end = 0;
  bool is_run = false;
};

/// A plane from begin to end, looked at in pieces: what repeats less long is nothing to gain from.
std::vector<Stretch> stretches_of(const unsigned char* plane, std::size_t count) {
  constexpr std::size_t piece = 512;
  std::vector<Stretch> found;
  for (std::size_t begin = 0; begin < count; begin += piece) {
    const std::size_t end = std::min(count, begin + piece);
    const bool is_run = std::memcmp(plane + begin, plane + begin + 1, end - begin - 1) == 0;
    const bool goes_on = !found.empty() && found.back().is_run == is_run &&
                         (!is_run || plane[begin] == plane[begin - 1]);
    if (goes_on)
      found.back().end = end;
    else
      found.push_back({begin, end, is_run});
  }
  return found;
}

/// What makes it not worth while to deflate a plane: of what is no run in it.
struct NoiseRule {
  double least_bits;    ///< of entropy per byte
  double most_repeats;  ///< share of bytes that are their neighbour's
  std::size_t one_of;   ///< pieces of so many are looked at
};

/// Where deflate gains at most 2.5 %: bytes are nearly equally frequent and hardly ever repeat
/// their neighbour (noise: 1 / 256), as the last bits of a Monte Carlo estimate are.
constexpr NoiseRule pure_noise{7.8, 1.0 / 32, 1};
/// As long as one waits for it: the plane of a mantissa's first bits costs half of all the time for
/// 5 % of the size (measured on a street, 8 realizations).
constexpr NoiseRule mostly_noise{7.5, 1.0 / 4, 4};
constexpr int patient_level = 6;
/// libdeflate's fastest, below it: its level 4 takes twice as long for planes that are no noise,
/// and saves 0.5 % of the size.
constexpr int quick_level = 1;

bool is_noise(const unsigned char* plane, const std::vector<Stretch>& stretches, NoiseRule rule) {
  constexpr std::size_t piece = 200;  // no divisor of a row: other columns in every row
  // Four counts at a time: equal bytes in a row would wait for each other.
  constexpr std::size_t lanes = 4;
  std::array<std::array<std::uint32_t, 256>, lanes> frequency{};
  std::size_t repeats = 0, looked_at = 0;
  for (const Stretch& stretch : stretches) {
    if (stretch.is_run) continue;
    for (std::size_t begin = stretch.begin; begin < stretch.end; begin += rule.one_of * piece) {
      const unsigned char* from = plane + begin;
      const std::size_t length = std::min(piece, stretch.end - begin);
      for (std::size_t k = 0; k < length; ++k) ++frequency[k % lanes][from[k]];
      for (std::size_t k = 1; k < length; ++k) repeats += from[k] == from[k - 1];
      looked_at += length;
    }
  }
  if (looked_at == 0) return true;  // runs, which take no room
  double bits = 0;                  // Shannon's entropy
  for (std::size_t byte = 0; byte < frequency[0].size(); ++byte) {
    std::uint32_t f = 0;
    for (const auto& lane : frequency) f += lane[byte];
    const double p = static_cast<double>(f) / static_cast<double>(looked_at);
    if (f > 0) bits -= p * std::log2(p);
  }
  return bits > rule.least_bits &&
         static_cast<double>(repeats) < rule.most_repeats * static_cast<double>(looked_at);
}

class Compressor {
 public:
  explicit Compressor(int level)
      : compressor_(libdeflate_alloc_compressor(level), &libdeflate_free_compressor) {
    if (!compressor_) throw std::bad_alloc();
  }
  libdeflate_compressor* get() const { return compressor_.get(); }

 private:
  std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor_;
};

/// A whole number as that many bytes; where they end.
unsigned char* put_number(unsigned char* to, std::size_t value, std::size_t bytes,
                          std::endian order) {
  for (std::size_t i = 0; i < bytes; ++i) {
    const std::size_t byte = order == std::endian::little ? i : bytes - 1 - i;
    *to++ = static_cast<unsigned char>(value >> (8 * byte));
  }
  return to;
}

/// What a stored deflate block (RFC 1951, 3.2.4) says of its length, from a whole byte on; where
/// that ends.
unsigned char* put_stored_length(unsigned char* to, std::size_t length) {
  to = put_number(to, length, 2, std::endian::little);
  return put_number(to, ~length, 2, std::endian::little);
}

/// Stored blocks, none of them the last; where they end.
constexpr std::size_t longest_stored = 0xffff, stored_head = 5;
unsigned char* put_stored(unsigned char* to, const unsigned char* from, std::size_t count) {
  for (std::size_t begin = 0; begin < count; begin += longest_stored) {
    const std::size_t length = std::min(longest_stored, count - begin);
    *to++ = 0;
    to = put_stored_length(to, length);
    to = std::copy_n(from + begin, length, to);
  }
  return to;
}

/// Bits of a deflate block, one code after another (RFC 1951, 3.1.1).
class BitWriter {
 public:
  explicit BitWriter(unsigned char* to) : to_(to) {}

  /// The lowest bit comes first, as of numbers.
  void number(unsigned value, int bits) {
    room_ |= std::uint64_t{value} << count_;
    for (count_ += bits; count_ >= 8; count_ -= 8, room_ >>= 8)
      *to_++ = static_cast<unsigned char>(room_);
  }
  /// The highest bit comes first, as of Huffman codes.
  void code(unsigned value, int bits) {
    for (int bit = bits - 1; bit >= 0; --bit) number((value >> bit) & 1U, 1);
  }
  /// Where whole bytes go on.
  unsigned char* end_of_byte() {
    if (count_ > 0) number(0, 8 - count_);
    return to_;
  }

 private:
  unsigned char* to_;
  std::uint64_t room_ = 0;
  int count_ = 0;
};

/// Bytes that `put_run` takes at most: 13 bits for each 258, and what begins and ends it.
constexpr std::size_t most_bytes_of_run(std::size_t count) { return count / 64 + 64; }

/// A block of fixed Huffman codes (RFC 1951, 3.2.6), not the last one, that stands for `count`
/// times `byte`: it once, then copies of what is one byte before. An empty stored block ends it
/// with a whole byte. Where it ends.
unsigned char* put_run(unsigned char* to, unsigned char byte, std::size_t count) {
  constexpr unsigned fixed_codes = 1, end_of_block = 0, one_byte_before = 0;
  constexpr std::size_t longest = 258;               // the longest copy, of code 285
  constexpr std::size_t shortest = 3, of_code = 10;  // copies of codes 257 … 264
  BitWriter bits(to);
  const auto literal = [&] {
    byte < 144 ? bits.code(0x30U + byte, 8) : bits.code(0x190U + byte - 144U, 9);
  };
  const auto copy = [&](std::size_t length) {
    length == longest ? bits.code(0xc5, 8)
                      : bits.code(static_cast<unsigned>(length - shortest + 1), 7);
    bits.code(one_byte_before, 5);
  };
  bits.number(fixed_codes << 1U, 3);
  literal();
  std::size_t left = count - 1;
  for (; left >= longest; left -= longest) copy(longest);
  for (; left >= of_code; left -= of_code) copy(of_code);
  if (left >= shortest)
    copy(left);
  else
    for (; left > 0; --left) literal();
  bits.code(end_of_block, 7);
  bits.number(0, 3);
  return put_stored_length(bits.end_of_byte(), 0);
}

/// A plane that is not searched for matches: its runs, and the rest as it is.
unsigned char* put_plane(unsigned char* to, const unsigned char* plane,
                         const std::vector<Stretch>& stretches) {
  for (const Stretch& of : stretches)
    to = of.is_run ? put_run(to, plane[of.begin], of.end - of.begin)
                   : put_stored(to, plane + of.begin, of.end - of.begin);
  return to;
}

/// Bytes that `put_plane` takes at most.
std::size_t most_bytes(const std::vector<Stretch>& stretches) {
  std::size_t bytes = 0;
  for (const Stretch& of : stretches) {
    const std::size_t count = of.end - of.begin;
    bytes +=
        of.is_run ? most_bytes_of_run(count) : count + stored_head * (count / longest_stored + 1);
  }
  return bytes;
}

/// A zlib stream (RFC 1950) that stores the leading planes of noise, but for their runs, where
/// matching costs most and gains least, and deflates the rest. Empty where it
/// would not be shorter than the planes.
Bytes zlib_stream(const Bytes& planes, std::size_t values, int level) {
  constexpr unsigned char method_and_window = 0x78, check_bits = 0x01;
  constexpr std::size_t check_bytes = 4;
  const bool is_patient = level >= patient_level;
  const NoiseRule rule = is_patient ? pure_noise : mostly_noise;
  thread_local Bytes stream;  // fresh memory of a megabyte costs more than what is done with it
  stream.resize(std::max<std::size_t>(stream.size(), 2));
  stream[0] = method_and_window;
  stream[1] = check_bits;
  std::size_t stored = 0, head = 2;
  for (; stored + values < planes.size(); stored += values) {
    const unsigned char* plane = planes.data() + stored;
    const auto stretches = stretches_of(plane, values);
    if (!is_noise(plane, stretches, rule)) break;
    stream.resize(std::max(stream.size(), head + most_bytes(stretches)));
    head =
        static_cast<std::size_t>(put_plane(stream.data() + head, plane, stretches) - stream.data());
  }
  if (head + check_bytes >= planes.size()) return {};
  stream.resize(std::max(stream.size(), planes.size()));
  unsigned char* to = stream.data() + head;
  const Compressor compressor(is_patient ? level : quick_level);
  const std::size_t length =
      libdeflate_deflate_compress(compressor.get(), planes.data() + stored, planes.size() - stored,
                                  to, planes.size() - head - check_bytes);
  if (length == 0 || head + length + check_bytes >= planes.size()) return {};
  to = put_number(to + length, libdeflate_adler32(1, planes.data(), planes.size()), check_bytes,
                  std::endian::big);
  Bytes whole;  // GCC 12 warns of memory that is not freed where it is built at once
  whole.assign(stream.data(), to);
  return whole;
}

Bytes encoded(const Piece& piece, int level) {
  if (level > 0) {
    thread_local Bytes planes;
    shuffled(piece, planes);
    Bytes deflated = zlib_stream(planes, piece.count(), level);
    if (!deflated.empty()) return deflated;
  }
  return plain(piece);
}

}  // namespace

float rounded(float value, int mantissa_bits) {
  SUNLOAD_EXPECT(are_mantissa_bits(mantissa_bits), "bits of a mantissa");
  return Rounding(mantissa_bits)(value);
}

std::vector<Bytes> encoded_chunks(const float* values, std::size_t rows, std::size_t columns,
                                  ChunkShape shape, int level, int mantissa_bits) {
  SUNLOAD_EXPECT(rows <= shape.rows && shape.columns > 0 && level >= 0, "shape of chunks");
  SUNLOAD_EXPECT(are_mantissa_bits(mantissa_bits), "bits of a mantissa");
  const Rounding rounding(mantissa_bits);
  std::vector<Bytes> chunks(shape.count(columns));
  parallel_for(chunks.size(), [&](std::size_t c) {
    chunks[c] = encoded({values, rows, columns, c * shape.columns, shape, rounding}, level);
  });
  return chunks;
}

std::vector<float> decoded_chunk(std::span<const unsigned char> chunk, ChunkShape shape) {
  std::vector<float> values(shape.rows * shape.columns);
  if (chunk.size() == shape.bytes()) {
    std::memcpy(values.data(), chunk.data(), chunk.size());
    return values;
  }
  Bytes planes(shape.bytes());
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)>
      decompressor(libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  if (!decompressor) throw std::bad_alloc();
  // Without a place for the length, anything but exactly the shape is an error.
  if (libdeflate_zlib_decompress(decompressor.get(), chunk.data(), chunk.size(), planes.data(),
                                 planes.size(), nullptr) != LIBDEFLATE_SUCCESS) {
    throw std::runtime_error("a chunk cannot be decompressed");
  }
  unshuffle(planes.data(), values.size(), reinterpret_cast<unsigned char*>(values.data()));
  return values;
}

}  // namespace sunload
