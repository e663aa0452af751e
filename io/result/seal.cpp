// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/result/seal.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <optional>
#include <vector>

#include "io/base/deflate.h"
#include "io/base/file_aside.h"
#include "io/base/file_writing.h"

namespace sunload {
namespace {

constexpr std::array<char, 8> magic{'S', 'L', 'S', 'E', 'A', 'L', '1', '\n'};
constexpr std::size_t read_bytes = 1 << 20;  // per read

struct Seal {
  std::array<char, 8> magic_bytes = magic;
  Extent series;
  std::uint64_t file_bytes = 0;
  std::uint32_t crc = 0, zero = 0;
};
static_assert(sizeof(Seal) == 40 && offsetof(Seal, crc) == 32, "file layout");

/// CRC-32 goes on over [begin, end).
std::uint32_t crc_of(std::ifstream& data, Extent extent, std::uint32_t crc) {
  std::vector<char> part(read_bytes);
  data.seekg(static_cast<std::streamoff>(extent.begin));
  while (extent.begin < extent.end) {
    const auto count =
        static_cast<std::size_t>(std::min<std::uint64_t>(extent.end - extent.begin, part.size()));
    if (!data.read(part.data(), static_cast<std::streamsize>(count))) {
      throw h5::Error("reading failed");
    }
    crc = crc32(part.data(), count, crc);
    extent.begin += count;
  }
  return crc;
}

std::uint32_t crc_of(const std::string& path, const Seal& seal) {
  std::ifstream data(path, std::ios::binary);
  const std::uint32_t crc = crc32(&seal, offsetof(Seal, crc));
  const std::uint32_t before = crc_of(data, {0, seal.series.begin}, crc);
  return crc_of(data, {seal.series.end, seal.file_bytes}, before);
}

/// The last bytes of a file, where they are a seal.
std::optional<Seal> seal_of(const std::string& path) {
  std::error_code unreadable;
  if (!std::filesystem::is_regular_file(path, unreadable)) return {};
  const std::uint64_t size = std::filesystem::file_size(path, unreadable);
  Seal seal;
  if (unreadable || size < sizeof seal) return {};
  std::ifstream data(path, std::ios::binary);
  data.seekg(static_cast<std::streamoff>(size - sizeof seal));
  const bool is_seal = data.read(reinterpret_cast<char*>(&seal), sizeof seal).good() &&
                       seal.magic_bytes == magic && seal.file_bytes == size - sizeof seal &&
                       seal.series.begin <= seal.series.end && seal.series.end <= seal.file_bytes;
  return is_seal ? std::optional(seal) : std::nullopt;
}

}  // namespace

void seal_result(const std::string& path, Extent series) {
  Seal seal;
  seal.file_bytes = h5::File::open(path).end();
  // HDF5 gives back what it reserved at the end and did not need: in a file of few patches the
  // end may come to lie before where series began.
  seal.series.end = std::min(series.end, seal.file_bytes);
  seal.series.begin = std::min(series.begin, seal.series.end);
  seal.crc = crc_of(path, seal);
  errno = 0;
  std::ofstream data(path, std::ios::binary | std::ios::app);
  data.write(reinterpret_cast<const char*>(&seal), sizeof seal);
  data.close();
  if (!data) throw_cannot_write(path, errno);
}

std::string seal_problem(const std::string& path) {
  const auto seal = seal_of(path);
  return !seal || seal->crc == crc_of(path, *seal) ? "" : "its checksum is wrong";
}

std::string end_problem(const std::string& path, const h5::File& file) {
  const auto seal = seal_of(path);
  const std::uint64_t end = file.end();
  const bool is_right = seal ? seal->file_bytes == end : std::filesystem::file_size(path) == end;
  return is_right ? "" : "its end is damaged";
}

}  // namespace sunload
