// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/first_light/ray_light.h"

namespace sunload {

SunSeconds lengths_of(std::span<const IntervalLight> block) {
  SunSeconds seconds{};
  for (std::size_t k = 0; k < block.size(); ++k) seconds[k] = block[k].length_s;
  return seconds;
}

std::vector<Columns> summed(const SunColumns& columns) {
  std::vector<Columns> sums = columns.direct;
  for (const auto* part : {&columns.mirror, &columns.circumsolar})
    for (std::size_t r = 0; r < part->size(); ++r)
      for (std::size_t at = 0; at < (*part)[r].size(); ++at) sums[r][at] += (*part)[r][at];
  return sums;
}

}  // namespace sunload
