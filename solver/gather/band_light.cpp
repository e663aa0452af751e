// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/gather/band_light.h"

#include "geo/base/check.h"
#include "geo/base/units.h"
#include "solver/base/chunks.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

double ratio(double of_band, double broadband) { return broadband > 0 ? of_band / broadband : 1; }

}  // namespace

std::vector<IntervalLight> suns_in_band(std::span<const IntervalLight> suns, std::size_t band) {
  std::vector<IntervalLight> of_band(suns.begin(), suns.end());
  for (auto& sun : of_band) {
    SUNLOAD_EXPECT(sun.bands.size() == band_count, "light of every band");
    IntervalLight::Band light = std::move(sun.bands[band]);
    sun.bands.clear();
    sun.dni = light.dni;
    sun.ground_exitance = light.ground_exitance;
    sun.sky = std::move(light.sky);
  }
  return of_band;
}

BandFactors sun_factors(std::span<const IntervalLight> broadband,
                        std::span<const IntervalLight> of_band) {
  BandFactors factors;
  factors.sun.fill(1);
  factors.circumsolar.fill(1);
  for (std::size_t k = 0; k < of_band.size(); ++k)
    factors.sun[k] = ratio(of_band[k].dni, broadband[k].dni);
  return factors;
}

BandFactors band_factors(const BlockSources& broadband, std::span<const IntervalLight> of_band,
                         std::size_t band) {
  BandFactors factors = sun_factors(broadband.suns, of_band);
  for (std::size_t k = 0; k < of_band.size(); ++k)
    factors.circumsolar[k] = broadband.circumsolar[k].band_factor(band);
  return factors;
}

BlockSources sources_in_band(const BlockSources& broadband, std::span<const IntervalLight> of_band,
                             const BandFactors& factors) {
  BlockSources sources(of_band, broadband.sky.size() / block_width);
  sources.circumsolar = broadband.circumsolar;
  sources.circumsolar_factor = factors.circumsolar;
  for (std::size_t k = 0; k < of_band.size(); ++k) {
    if (!sources.circumsolar[k].any()) continue;
    for (std::size_t c = 0; c < of_band[k].sky.size(); ++c)
      sources.sky_of_lines[c * block_width + k] =
          static_cast<float>(pi * sources.radiance_for_lines(k, c));
  }
  return sources;
}

Columns scaled(Columns columns, const std::array<double, block_width>& factors) {
  std::array<float, block_width> of_sun;
  for (std::size_t k = 0; k < block_width; ++k) of_sun[k] = static_cast<float>(factors[k]);
  parallel_for(
      columns.size() / block_width,
      [&](std::size_t i) {
        for (std::size_t k = 0; k < block_width; ++k) columns[i * block_width + k] *= of_sun[k];
      },
      receivers_per_chunk);
  return columns;
}

void add_weighted(const std::vector<Columns>& of_realizations,
                  const std::array<double, block_width>& weights,
                  std::vector<std::vector<double>>& sums) {
  for (std::size_t r = 0; r < of_realizations.size(); ++r) {
    const Columns& irradiance = of_realizations[r];
    parallel_for(
        irradiance.size() / block_width,
        [&](std::size_t i) {
          for (std::size_t k = 0; k < block_width; ++k)
            sums[r][i] += weights[k] * static_cast<double>(irradiance[i * block_width + k]);
        },
        receivers_per_chunk);
  }
}

}  // namespace sunload
