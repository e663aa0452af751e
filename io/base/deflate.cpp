// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/deflate.h"

#include <libdeflate.h>

#include <memory>
#include <new>

namespace sunload {

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

}  // namespace sunload
