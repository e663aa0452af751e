// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Chunks of float series as HDF5 stores them: byte shuffle, then zlib deflate.
///
/// A chunk always has its full shape: past the edges of an array it is padded
/// with NaN, the fill value of the series. A chunk that deflate does not make
/// smaller, and every chunk at level 0, is stored as it is (neither shuffled
/// nor deflated): its length is then `ChunkShape::bytes()`.
///
/// Values may be rounded first, to the nearest with fewer bits in the mantissa, halves to even
/// (bit rounding; Kouznetsov 2021, Geosci. Model Dev. 14): the bits left out are 0, and cost next
/// to nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/base/deflate.h"

namespace sunload {

/// Values of a chunk: rows in time, columns of patches.
struct ChunkShape {
  std::size_t rows = 0, columns = 0;

  std::size_t bytes() const { return rows * columns * sizeof(float); }
  /// Number of chunks side by side in an array of that many columns.
  std::size_t count(std::size_t array_columns) const {
    return (array_columns + columns - 1) / columns;
  }
};

/// Stored bits of a float's mantissa.
inline constexpr int all_mantissa_bits = 23;

/// `value` with the first `mantissa_bits` (1 … 23) of its mantissa: the relative error is at most
/// 2^-(mantissa_bits + 1). What is no finite number stays as it is.
float rounded(float value, int mantissa_bits);

/// One row of chunks, from `rows` ≤ shape.rows rows of `columns` values, in
/// parallel; level 0 (stored) … 9 (smallest). The same bytes for any number of threads.
std::vector<Bytes> encoded_chunks(const float* values, std::size_t rows, std::size_t columns,
                                  ChunkShape shape, int level,
                                  int mantissa_bits = all_mantissa_bits);

/// Inverse for one chunk: shape.rows × shape.columns values. Throws
/// std::runtime_error where the bytes are not such a chunk.
std::vector<float> decoded_chunk(std::span<const unsigned char> chunk, ChunkShape shape);

}  // namespace sunload
