// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Batch files: as they come, and, where the first byte is odd, with checksums that are right, so
// that what lies behind them is read: a byte with the number of blocks, the header's JSON, a
// zero byte, the blocks' bytes in equal parts.
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "io/batch/container.h"
#include "io/batch/file.h"
#include "tests/fuzz/fuzz_target.h"

namespace sunload::fuzz {

namespace {

/// Empty where the bytes make no header.
std::string file_with_checksums(std::string_view bytes) {
  const std::size_t count = take_byte(bytes) % 8;
  const auto end = std::min(bytes.find('\0'), bytes.size());
  const auto header = nlohmann::json::parse(bytes.substr(0, end), nullptr, false);
  if (!header.is_object()) return {};
  bytes.remove_prefix(std::min(end + 1, bytes.size()));
  std::vector<BlockPieces> blocks;
  for (std::size_t b = 0; b < count; ++b) {
    const auto part = bytes.substr(b * bytes.size() / count,
                                   (b + 1) * bytes.size() / count - b * bytes.size() / count);
    blocks.push_back({{reinterpret_cast<const unsigned char*>(part.data()), part.size()}});
  }
  const auto path = file_of({}, "checked.batch");
  std::filesystem::remove(path);
  try {
    write_container(path, header, blocks);
  } catch (const nlohmann::json::exception&) {
    return {};  // text that is no UTF-8 cannot be written
  }
  return path;
}

void read_all(const std::string& path) {
  const BatchReader reader(path);
  reader.verify();
  for (const auto& array : reader.arrays()) {
    reader.doubles(array.name);
    if (reader.spec(array.name).type == ArrayType::float32) reader.floats(array.name);
    for (std::size_t c = 0; c < reader.chunk_count(array.name); ++c) reader.chunk(array.name, c);
  }
}

}  // namespace

static const Registered target("batch", [](std::string_view bytes) {
  const bool has_right_checksums = take_byte(bytes) % 2 == 1;
  const auto path =
      has_right_checksums ? file_with_checksums(bytes) : file_of(bytes, "hostile.batch");
  if (!path.empty()) read_all(path);
});

}  // namespace sunload::fuzz
