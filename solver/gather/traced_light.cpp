// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/gather/traced_light.h"

namespace sunload {

namespace {

void scale(Columns& columns, const std::array<double, block_width>& factors) {
  columns = scaled(std::move(columns), factors);
}

void scale(SunColumns& of_realizations, const BandFactors& factors) {
  for (auto& one : of_realizations.direct) scale(one, factors.sun);
  for (auto& one : of_realizations.by_mirror) scale(one, factors.sun);
  for (auto& one : of_realizations.circumsolar) scale(one, factors.circumsolar);
}

void scale(SunFates& fates, const std::array<double, block_width>& factors) {
  for (std::size_t k = 0; k < block_width; ++k) fates[k] = scaled(fates[k], factors[k]);
}

}  // namespace

std::vector<Columns> traced_sums(const SunColumns& columns) {
  std::vector<Columns> sums = columns.direct;
  for (const auto* part : {&columns.by_mirror, &columns.circumsolar})
    for (std::size_t r = 0; r < part->size(); ++r)
      for (std::size_t at = 0; at < (*part)[r].size(); ++at) sums[r][at] += (*part)[r][at];
  return sums;
}

void add_exposures(const TracedLight& traced, const BandFactors& factors,
                   std::span<const SunLight> suns, TimeSums& sums) {
  std::array<double, block_width> sun_s{}, sky_s{};
  for (std::size_t k = 0; k < suns.size(); ++k) {
    sun_s[k] = factors.sun[k] * suns[k].length_s;
    sky_s[k] = factors.circumsolar[k] * suns[k].length_s;
  }
  add_weighted(traced.of_patches.direct, sun_s, sums.direct);
  add_weighted(traced.of_patches.by_mirror, sun_s, sums.by_mirror);
  add_weighted(traced.of_patches.circumsolar, sky_s, sums.circumsolar);
  add_weighted(traced.of_sensors.direct, sun_s, sums.sensor_direct);
  add_weighted(traced.of_sensors.by_mirror, sun_s, sums.sensor_by_mirror);
}

TracedLight in_band(const TracedLight& traced, const BandFactors& factors, Errors errors) {
  const bool of_instants = errors == Errors::instants;
  TracedLight light{.direct = traced.direct,
                    .on_sensors = traced.on_sensors,
                    .circumsolar = traced.circumsolar,
                    .by_mirror = traced.by_mirror,
                    .on_sensors_by_mirror = traced.on_sensors_by_mirror,
                    .of_patches = of_instants ? traced.of_patches : SunColumns{},
                    .of_sensors = of_instants ? traced.of_sensors : SunColumns{},
                    .by_samples = {},
                    .sent_on = traced.sent_on};
  scale(light.direct.irradiance, factors.sun);
  scale(light.on_sensors.irradiance, factors.sun);
  scale(light.circumsolar.irradiance, factors.circumsolar);
  scale(light.by_mirror, factors.sun);
  scale(light.on_sensors_by_mirror, factors.sun);
  scale(light.of_patches, factors);
  scale(light.of_sensors, factors);
  for (auto& of_realization : light.sent_on) scale(of_realization, factors.sun);
  return light;
}

}  // namespace sunload
