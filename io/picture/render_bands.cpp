// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/render_bands.h"

#include <algorithm>
#include <array>

#include "geo/base/check.h"
#include "io/result/shown_quantity.h"

namespace sunload {

BandColours colours_of_bands(const ResultReader& result, const std::string& dataset,
                             const std::string& time, const std::optional<double>& largest,
                             const std::vector<double>& area) {
  if (result.bands() == Bands::broadband || result.band())
    throw InputError(
        {result.path()}, "--colour rgb needs all bands of a result in bands",
        result.band() ? "--band chooses one" : "this one has none",
        result.band() ? "leave --band away" : "compute the study with solver.bands: rgb");
  std::array<std::vector<double>, band_count> bands;
  std::vector<double> brightest(area.size(), 0);
  for (std::size_t b = 0; b < band_count; ++b) {
    ResultReader of_band(result.path(), b);
    of_band.choose(result.chosen());
    bands[b] = shown_quantity(of_band, dataset, time).values;
    for (std::size_t i = 0; i < area.size(); ++i)
      brightest[i] = std::max(brightest[i], bands[b][i]);
  }
  BandColours colours;
  colours.white = scale_end(largest, brightest, area);
  const auto share = [&](double value) { return std::clamp(value / colours.white, 0.0, 1.0); };
  for (std::size_t i = 0; i < area.size(); ++i)
    colours.of_patches.push_back({share(bands[0][i]), share(bands[1][i]), share(bands[2][i])});
  return colours;
}

std::string band_title(const ResultReader& result) {
  if (result.band()) return std::string(", ") + band_names[*result.band()];
  return result.bands() == Bands::rgb ? ", mean of the bands" : "";
}

}  // namespace sunload
