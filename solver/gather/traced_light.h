// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What a block of suns brings to patches and sensors by rays, before any diffuse reflection.
#pragma once

#include <span>
#include <vector>

#include "solver/first_light/circumsolar.h"
#include "solver/first_light/direct_sun.h"
#include "solver/first_light/mirror_chains.h"
#include "solver/gather/band_light.h"
#include "solver/gather/time_sums.h"

namespace sunload {

/// The sun's irradiance of each realization, straight and by mirrors; empty where neither errors
/// per instant nor bands are asked for.
struct SunColumns {
  std::vector<Columns> direct, by_mirror, circumsolar;  ///< [R]
  SunColumns() = default;
  SunColumns(std::size_t realizations, std::size_t receivers)
      : direct(realizations, columns(receivers)), by_mirror(direct), circumsolar(direct) {}
};
/// For functions that fill such columns only if they are asked for.
inline std::vector<Columns>* or_none(std::vector<Columns>& of_realizations) {
  return of_realizations.empty() ? nullptr : &of_realizations;
}

/// The sum of all columns of each realization.
std::vector<Columns> traced_sums(const SunColumns& columns);

struct TracedLight {
  DirectSun direct, on_sensors;
  CircumsolarLight circumsolar;
  Columns by_mirror, on_sensors_by_mirror;
  SunColumns of_patches, of_sensors;
  std::vector<Columns> by_samples;  ///< [R] of patches, all but gloss; if asked for
  std::vector<SunFates> sent_on;    ///< [R] by mirrors and gloss, where the scene has any
};

/// Adds the time integrals of a band: `suns` have its light, relative to the traced one `factors`.
void add_exposures(const TracedLight& traced, const BandFactors& factors,
                   std::span<const SunLight> suns, TimeSums& sums);

/// The light of a band: all of it is proportional to the sun, or to the circumsolar sky. Columns
/// of realizations come along for errors per instant alone.
TracedLight in_band(const TracedLight& traced, const BandFactors& factors, Errors errors);

}  // namespace sunload
