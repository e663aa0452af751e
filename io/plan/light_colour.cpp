// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/plan/light_colour.h"

#include <algorithm>
#include <cmath>

#include "geo/sky/sky_colour.h"

namespace sunload {

namespace {

constexpr double brightest_bin = 6.2;  // Perez et al. (1990), table 1
constexpr int last_overcast_type = 5, last_intermediate_type = 10;
constexpr BandShares white{1, 1, 1};

/// A colour without its brightness, a share of it mixed with white.
BandShares balanced(Rgb colour, double share) {
  const BandShares rgb{colour.red, colour.green, colour.blue};
  const double mean = mean_of(rgb);
  if (mean <= 0) return white;
  BandShares balanced;
  for (std::size_t b = 0; b < band_count; ++b) balanced[b] = 1 + share * (rgb[b] / mean - 1);
  return balanced;
}

double horizontal(const std::vector<double>& radiance, const SkyGrid& grid) {
  double sum = 0;
  for (std::size_t c = 0; c < radiance.size(); ++c) sum += radiance[c] * grid.projected()[c];
  return sum;
}

}  // namespace

double blue_share(const LitInterval& interval, const LightStudy& light) {
  switch (light.sky) {
    case SkyModel::uniform:
    case SkyModel::cie_overcast:
      return 0;
    case SkyModel::cie_clear:
    case SkyModel::preetham:
      return 1;
    case SkyModel::cie_general:
      return light.sky_type <= last_overcast_type       ? 0
             : light.sky_type <= last_intermediate_type ? 0.5
                                                        : 1;
    case SkyModel::perez:
      break;
  }
  const Irradiance& mean = interval.of_the_sky;
  const double zenith_deg = std::clamp(90 - interval.when.sun.elevation_deg, 0.0, 90.0);
  const double clearness =
      sky_condition(mean.dni, mean.dhi, zenith_deg, extraterrestrial(interval.when.sun.distance_au))
          .clearness;
  return std::clamp((clearness - 1) / (brightest_bin - 1), 0.0, 1.0);
}

std::vector<IntervalLight::Band> light_in_bands(const IntervalLight& sun, const Irradiance& source,
                                                const LitInterval& interval,
                                                const LightStudy& light, const SkyGrid& grid) {
  const bool is_coloured = light.colour == LightColour::sky;
  const double blue = is_coloured ? blue_share(interval, light) : 0;
  const BandShares sunlight =
      balanced(sunlight_colour(interval.when.sun.elevation_deg), is_coloured ? 1 : 0);
  std::vector<IntervalLight::Band> bands(band_count);
  for (std::size_t b = 0; b < band_count; ++b) bands[b] = {sun.dni * sunlight[b], 0, sun.sky};
  for (std::size_t c = 0; blue > 0 && c < sun.sky.size(); ++c) {
    const Vec3 w = grid.direction(static_cast<int>(c), 0.5, 0.5);
    const BandShares colour = balanced(sky_colour(SkyColourModel::second, w, sun.direction), blue);
    for (std::size_t b = 0; b < band_count; ++b) bands[b].sky[c] = sun.sky[c] * colour[b];
  }
  const double of_sky = horizontal(sun.sky, grid);
  const double beam = std::max(0.0, source.ghi - source.dhi), diffuse = source.dhi;
  for (std::size_t b = 0; b < band_count; ++b) {
    const double sky_share = of_sky > 0 ? horizontal(bands[b].sky, grid) / of_sky : 1;
    const double share =
        beam + diffuse > 0 ? (beam * sunlight[b] + diffuse * sky_share) / (beam + diffuse) : 1;
    bands[b].ground_exitance = sun.ground_exitance * share;
  }
  return bands;
}

}  // namespace sunload
