// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/measure/series_measure.h"

namespace sunload {

SeriesMeasure::SeriesMeasure(const std::string& light, const MeasuredScene& scene)
    : series_(light == "total" ? "irradiance" : "irradiance_" + light), scene_(scene) {}

void SeriesMeasure::watch(const SeriesRows& rows) {
  const std::size_t sensors = points() - scene_.patches;
  for (std::size_t row = 0; row < rows.rows; ++row) {
    const MeasuredInterval& interval = scene_.intervals[rows.first + row];
    for (std::size_t i = 0; i < scene_.patches; ++i)
      take(i, rows.patch[row * scene_.patches + i], interval);
    for (std::size_t s = 0; s < sensors; ++s)
      take(scene_.patches + s, rows.sensor[row * sensors + s], interval);
  }
}

}  // namespace sunload
