// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Deflate and its checksum.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sunload {

using Bytes = std::vector<unsigned char>;

/// A zlib stream of any bytes, at libdeflate's level 1 … 12; 0 stores them beside their checksum.
Bytes zlib_deflated(std::span<const unsigned char> bytes, int level);

/// CRC-32 (zlib's) of bytes, continuing `before`.
std::uint32_t crc32(const void* bytes, std::size_t count, std::uint32_t before = 0);

}  // namespace sunload
