// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/transport/band_rays.h"

namespace sunload {

namespace {

using Factors = std::array<double, block_width>;

RayColumns scaled(const RayColumns& rays, const BandFactors& factors) {
  return {scaled(rays.direct, factors.sun), scaled(rays.mirror, factors.sun),
          scaled(rays.circumsolar, factors.circumsolar)};
}

void scale(std::vector<Columns>& of_realizations, const Factors& factors) {
  for (auto& one : of_realizations) one = scaled(std::move(one), factors);
}

void scale(SunFates& fates, const Factors& factors) {
  for (std::size_t k = 0; k < block_width; ++k) fates[k] = scaled(fates[k], factors[k]);
}

RayLight in_band(const RayLight& rays, const BandFactors& factors, Errors errors) {
  RayLight light{.pooled = scaled(rays.pooled, factors),
                 .sunlit = rays.sunlit,
                 .of_realizations = {},
                 .by_samples = {}};
  if (errors == Errors::totals) return light;
  light.of_realizations = rays.of_realizations;
  scale(light.of_realizations.direct, factors.sun);
  scale(light.of_realizations.mirror, factors.sun);
  scale(light.of_realizations.circumsolar, factors.circumsolar);
  return light;
}

}  // namespace

void add_exposures(const BlockRays& rays, const BandFactors& factors,
                   std::span<const IntervalLight> suns, TimeSums& sums) {
  Factors sun_s{}, sky_s{};
  for (std::size_t k = 0; k < suns.size(); ++k) {
    sun_s[k] = factors.sun[k] * suns[k].length_s;
    sky_s[k] = factors.circumsolar[k] * suns[k].length_s;
  }
  const auto add = [&](const SunColumns& columns, RaySums& to) {
    add_weighted(columns.direct, sun_s, to.direct);
    add_weighted(columns.mirror, sun_s, to.mirror);
    add_weighted(columns.circumsolar, sky_s, to.circumsolar);
  };
  add(rays.on_patches.of_realizations, sums.on_patches);
  add(rays.on_sensors.of_realizations, sums.on_sensors);
}

BlockRays in_band(const BlockRays& rays, const BandFactors& factors, Errors errors) {
  BlockRays light{.on_patches = in_band(rays.on_patches, factors, errors),
                  .on_sensors = in_band(rays.on_sensors, factors, errors),
                  .sent_on = rays.sent_on};
  for (auto& of_realization : light.sent_on) scale(of_realization, factors.sun);
  return light;
}

}  // namespace sunload
