// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/light/packed_columns.h"

#include <algorithm>

#include "geo/base/vector_code.h"
#include "solver/base/chunks.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

constexpr float largest_code = 65535, nothing = 1e-30f;  // W m-2

/// Of each column, from that value on.
SUNLOAD_VECTOR_CODE void take_largest(const float* __restrict values, std::size_t rows,
                                      float* __restrict largest) {
  for (std::size_t i = 0; i < rows; ++i, values += block_width)
#pragma GCC unroll 1  // else the compiler makes it scalar
    for (std::size_t k = 0; k < block_width; ++k)
      largest[k] = values[k] > largest[k] ? values[k] : largest[k];
}

std::array<float, block_width> largest_of_columns(const Columns& values) {
  using Largest = std::array<float, block_width>;
  const std::size_t rows = values.size() / block_width;
  std::vector<Largest> of_chunks(chunk_count(rows, receivers_per_chunk));
  parallel_chunks(rows, receivers_per_chunk, [&](std::size_t begin, std::size_t end) {
    take_largest(&values[begin * block_width], end - begin,
                 of_chunks[begin / receivers_per_chunk].data());
  });
  Largest largest{};
  for (const Largest& of_chunk : of_chunks)
    for (std::size_t k = 0; k < block_width; ++k) largest[k] = std::max(largest[k], of_chunk[k]);
  for (float& of_column : largest)
    if (!(of_column > nothing)) of_column = 0;
  return largest;
}

/// Codes of some rows of values. `per_unit`: of each column, one over its factor, or 0.
SUNLOAD_VECTOR_CODE void pack(const float* __restrict values, std::size_t rows,
                              const float* __restrict per_unit, float* __restrict of_row,
                              std::uint16_t* __restrict code) {
  alignas(64) float share[block_width];
  for (std::size_t i = 0; i < rows; ++i, values += block_width, code += block_width) {
#pragma GCC unroll 1  // as above
    for (std::size_t k = 0; k < block_width; ++k)
      share[k] = (values[k] > 0 ? values[k] : 0.0f) * per_unit[k];
    float largest = 0;
#pragma GCC unroll 1
    for (std::size_t k = 0; k < block_width; ++k) largest = share[k] > largest ? share[k] : largest;
    const bool is_any = largest > nothing;
    of_row[i] = is_any ? largest / largest_code : 0;
    const float codes_per_unit = is_any ? largest_code / largest : 0;
#pragma GCC unroll 1
    for (std::size_t k = 0; k < block_width; ++k) {
      const float rounded = share[k] * codes_per_unit + 0.5f;
      code[k] = static_cast<std::uint16_t>(
          static_cast<std::int32_t>(rounded < largest_code ? rounded : largest_code));
    }
  }
}

}  // namespace

PackedColumns::PackedColumns(const Columns& values)
    : of_column_(largest_of_columns(values)),
      of_row_(values.size() / block_width),
      code_(values.size()) {
  std::array<float, block_width> per_unit;
  for (std::size_t k = 0; k < block_width; ++k)
    per_unit[k] = of_column_[k] > 0 ? 1 / of_column_[k] : 0;
  parallel_chunks(rows(), receivers_per_chunk, [&](std::size_t begin, std::size_t end) {
    pack(&values[begin * block_width], end - begin, per_unit.data(), &of_row_[begin],
         &code_[begin * block_width]);
  });
}

}  // namespace sunload
