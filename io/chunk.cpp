#include "io/chunk.h"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <stdexcept>

#include "geo/check.h"
#include "solver/parallel.h"

static_assert(std::endian::native == std::endian::little,
              "series are stored as they lie in memory");

namespace sunload {
namespace {

constexpr float fill = std::numeric_limits<float>::quiet_NaN();

/// The filter "shuffle" of HDF5: first byte of all values, second byte of all …
void shuffle(const unsigned char* values, std::size_t count, unsigned char* planes) {
  for (std::size_t i = 0; i < count; ++i) {
    planes[i] = values[4 * i];
    planes[count + i] = values[4 * i + 1];
    planes[2 * count + i] = values[4 * i + 2];
    planes[3 * count + i] = values[4 * i + 3];
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

/// The chunk whose first column is `first`, padded to its shape.
std::vector<float> padded(const float* values, std::size_t rows, std::size_t columns,
                          std::size_t first, ChunkShape shape) {
  std::vector<float> chunk(shape.rows * shape.columns, fill);
  const std::size_t width = std::min(shape.columns, columns - first);
  for (std::size_t row = 0; row < rows; ++row) {
    std::copy_n(values + row * columns + first, width, chunk.data() + row * shape.columns);
  }
  return chunk;
}

/// Whether deflate would gain nothing on a plane: its bytes are nearly equally
/// frequent and hardly ever repeat their neighbour, as the last bits of noise are.
bool is_noise(const unsigned char* plane, std::size_t count) {
  constexpr double least_bits = 7.8;         // per byte: a gain of at most 2.5 %
  constexpr double most_repeats = 1.0 / 32;  // noise: 1 / 256; the rest may be dark rows
  std::array<std::size_t, 256> frequency{};
  std::size_t repeats = 0;
  for (std::size_t i = 0; i < count; ++i) ++frequency[plane[i]];
  for (std::size_t i = 1; i < count; ++i) repeats += plane[i] == plane[i - 1];
  double bits = 0;  // Shannon's entropy
  for (const std::size_t f : frequency) {
    const double p = static_cast<double>(f) / static_cast<double>(count);
    if (f > 0) bits -= p * std::log2(p);
  }
  return bits > least_bits &&
         static_cast<double>(repeats) < most_repeats * static_cast<double>(count);
}

/// Appends a whole number as that many bytes.
void append_number(Bytes& to, std::size_t value, std::size_t bytes, std::endian order) {
  for (std::size_t i = 0; i < bytes; ++i) {
    const std::size_t byte = order == std::endian::little ? i : bytes - 1 - i;
    to.push_back(static_cast<unsigned char>(value >> (8 * byte)));
  }
}

/// Deflate blocks of type "stored" (RFC 1951, 3.2.4), none of them the last.
void append_stored(Bytes& to, const unsigned char* from, std::size_t count) {
  constexpr std::size_t longest = 0xffff;
  for (std::size_t begin = 0; begin < count; begin += longest) {
    const std::size_t length = std::min(longest, count - begin);
    to.push_back(0);
    append_number(to, length, 2, std::endian::little);
    append_number(to, ~length, 2, std::endian::little);
    to.insert(to.end(), from + begin, from + begin + length);
  }
}

/// A zlib stream (RFC 1950) that stores the leading planes of pure noise, where
/// matching costs most and gains nothing, and deflates the rest. Empty where it
/// would not be shorter than the planes.
Bytes zlib_stream(const Bytes& planes, std::size_t values, int level) {
  constexpr unsigned char method_and_window = 0x78, check_bits = 0x01;
  Bytes stream{method_and_window, check_bits};
  stream.reserve(planes.size());
  std::size_t stored = 0;
  while (stored + values < planes.size() && is_noise(planes.data() + stored, values))
    stored += values;
  append_stored(stream, planes.data(), stored);

  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(level), &libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  const std::size_t head = stream.size();
  stream.resize(planes.size());
  const std::size_t tail =
      libdeflate_deflate_compress(compressor.get(), planes.data() + stored, planes.size() - stored,
                                  stream.data() + head, stream.size() - head);
  if (tail == 0) return {};
  stream.resize(head + tail);
  append_number(stream, libdeflate_adler32(1, planes.data(), planes.size()), 4, std::endian::big);
  return stream.size() < planes.size() ? Bytes(stream) : Bytes{};
}

Bytes encoded(const std::vector<float>& chunk, int level) {
  const auto* raw = reinterpret_cast<const unsigned char*>(chunk.data());
  const std::size_t bytes = chunk.size() * sizeof(float);
  if (level > 0) {
    Bytes planes(bytes);
    shuffle(raw, chunk.size(), planes.data());
    Bytes deflated = zlib_stream(planes, chunk.size(), level);
    if (!deflated.empty()) return deflated;
  }
  return {raw, raw + bytes};
}

}  // namespace

std::vector<Bytes> encoded_chunks(const float* values, std::size_t rows, std::size_t columns,
                                  ChunkShape shape, int level) {
  SUNLOAD_EXPECT(rows <= shape.rows && shape.columns > 0 && level >= 0, "shape of chunks");
  std::vector<Bytes> chunks(shape.count(columns));
  parallel_for(chunks.size(), [&](std::size_t c) {
    chunks[c] = encoded(padded(values, rows, columns, c * shape.columns, shape), level);
  });
  return chunks;
}

Bytes zlib_deflated(std::span<const unsigned char> bytes, int level) {
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(level), &libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  Bytes stream(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()));
  stream.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(),
                                         stream.data(), stream.size()));
  return stream;
}

std::uint32_t crc32(const void* bytes, std::size_t count, std::uint32_t before) {
  // libdeflate starts anew where it is given no buffer, as an empty vector has none.
  return count == 0 ? before : libdeflate_crc32(before, bytes, count);
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
