// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/light/packed_columns.h"

#include <algorithm>

#include "solver/base/chunks.h"
#include "solver/base/threads.h"

namespace sunload {

PackedColumns::PackedColumns(const Columns& values)
    : factor_(values.size() / block_width), code_(values.size()) {
  constexpr float largest_code = 65535, nothing = 1e-30f;  // W m-2
  parallel_for(
      rows(),
      [&](std::size_t i) {
        const float* const from = values.data() + i * block_width;
        const float largest = *std::max_element(from, from + block_width);
        if (!(largest > nothing)) return;  // all codes are 0
        factor_[i] = largest / largest_code;
        const float codes_per_unit = largest_code / largest;
        for (std::size_t k = 0; k < block_width; ++k) {
          const float rounded = std::max(from[k], 0.0f) * codes_per_unit + 0.5f;
          code_[i * block_width + k] = static_cast<std::uint16_t>(std::min(rounded, largest_code));
        }
      },
      receivers_per_chunk);
}

}  // namespace sunload
