// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/light/packed_columns.h"

#include <algorithm>

#include "solver/base/chunks.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

constexpr float largest_code = 65535, nothing = 1e-30f;  // W m-2

std::array<float, block_width> largest_of_columns(const Columns& values) {
  using Largest = std::array<float, block_width>;
  const std::size_t rows = values.size() / block_width;
  std::vector<Largest> of_chunks(chunk_count(rows, receivers_per_chunk));
  parallel_chunks(rows, receivers_per_chunk, [&](std::size_t begin, std::size_t end) {
    Largest& of_chunk = of_chunks[begin / receivers_per_chunk];
    for (std::size_t at = begin * block_width; at < end * block_width; at += block_width)
      for (std::size_t k = 0; k < block_width; ++k)
        of_chunk[k] = std::max(of_chunk[k], values[at + k]);
  });
  Largest largest{};
  for (const Largest& of_chunk : of_chunks)
    for (std::size_t k = 0; k < block_width; ++k) largest[k] = std::max(largest[k], of_chunk[k]);
  for (float& of_column : largest)
    if (!(of_column > nothing)) of_column = 0;
  return largest;
}

}  // namespace

PackedColumns::PackedColumns(const Columns& values)
    : of_column_(largest_of_columns(values)),
      of_row_(values.size() / block_width),
      code_(values.size()) {
  std::array<float, block_width> per_unit;
  for (std::size_t k = 0; k < block_width; ++k)
    per_unit[k] = of_column_[k] > 0 ? 1 / of_column_[k] : 0;
  parallel_for(
      rows(),
      [&](std::size_t i) {
        std::array<float, block_width> share;
        for (std::size_t k = 0; k < block_width; ++k)
          share[k] = std::max(values[i * block_width + k], 0.0f) * per_unit[k];
        const float largest = *std::max_element(share.begin(), share.end());
        if (!(largest > nothing)) {
          std::fill_n(&code_[i * block_width], block_width, std::uint16_t{0});
          return;
        }
        of_row_[i] = largest / largest_code;
        const float codes_per_unit = largest_code / largest;
        for (std::size_t k = 0; k < block_width; ++k) {
          const float rounded = share[k] * codes_per_unit + 0.5f;
          code_[i * block_width + k] = static_cast<std::uint16_t>(std::min(rounded, largest_code));
        }
      },
      receivers_per_chunk);
}

}  // namespace sunload
