// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/stored_series.h"

#include "io/plan/rules_of_study.h"
#include "io/plan/stored_bits.h"

namespace sunload {

std::vector<std::string> unwanted_series(const OutputStudy& output) {
  std::vector<std::string> unwanted;
  for (std::size_t p = 0; p < part_count; ++p)
    if (!stores_series(output, static_cast<Part>(p)))
      for (const auto& prefix : {std::string(), sensor_prefix})
        unwanted.push_back(prefix + series_name(static_cast<Part>(p)));
  return unwanted;
}

StoredSeries stored_series(const Study& study) {
  return {.left_out = unwanted_series(study.output), .mantissa_bits = stored_bits(study)};
}

}  // namespace sunload
