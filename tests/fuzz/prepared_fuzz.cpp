// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Prepared files: as they come, and, where the first byte is odd, with checksums that are right:
// a byte with the number of counts, the counts, and all that follows them.
#include "io/batch/prepared_file.h"

#include <cstring>

#include "io/base/byte_text.h"
#include "io/batch/chunk.h"
#include "tests/fuzz/fuzz_target.h"

namespace sunload::fuzz {

namespace {

constexpr std::string_view magic{"sunload-lines-4\0", 16};
constexpr std::string_view hash = "hash";

std::string with_checksums(std::string_view bytes) {
  constexpr auto little = std::endian::little;
  const auto count = static_cast<std::uint64_t>(take_byte(bytes) % 5);
  std::string file(magic);
  append_bytes<little>(file, static_cast<std::uint64_t>(hash.size()));
  file += hash;
  append_bytes<little>(file, count);
  const auto counts = bytes.substr(0, count * sizeof(std::uint64_t));
  file += counts;
  bytes.remove_prefix(counts.size());
  append_bytes<little>(file, crc32(file.data(), file.size()));
  file += bytes;
  append_bytes<little>(file, crc32(file.data(), file.size()));
  return file;
}

}  // namespace

static const Registered target("prepared", [](std::string_view bytes) {
  const bool has_right_checksums = take_byte(bytes) % 2 == 1;
  const std::string file = has_right_checksums ? with_checksums(bytes) : std::string(bytes);
  read_prepared(file_of(file, "prepared"), std::string(hash));
});

}  // namespace sunload::fuzz
