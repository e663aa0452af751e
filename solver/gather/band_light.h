// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The light of a block in one band (solver/light/band.h), from broadband light that was traced.
///
/// Lines and shadow rays are geometry and serve all bands; what differs is the light that they
/// carry and what patches reflect diffusely. Mirrors, panes, metals, gloss, crowns and lamps are
/// grey: light that comes by them is proportional to its source.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "solver/gather/block_light.h"
#include "solver/light/band.h"

namespace sunload {

/// The suns of a block with the light of one band in place of the broadband one.
std::vector<IntervalLight> suns_in_band(std::span<const IntervalLight> suns, std::size_t band);

/// Light of a block in one band relative to the broadband light that was traced.
struct BandFactors {
  std::array<double, block_width> sun, circumsolar;
};
/// Factors of every sun of a block in that band. A sun without direct light has the factor 1.
BandFactors band_factors(const BlockSources& broadband, std::span<const IntervalLight> of_band,
                         std::size_t band);
/// The same where no rays were traced to the sky about the sun.
BandFactors sun_factors(std::span<const IntervalLight> broadband,
                        std::span<const IntervalLight> of_band);

/// Sources of a block in one band; `of_band` must outlive them. The circumsolar part is the
/// broadband one in one colour; what is left of the band's sky there stays with the lines.
BlockSources sources_in_band(const BlockSources& broadband, std::span<const IntervalLight> of_band,
                             const BandFactors& factors);

/// Every row times the factor of its sun. No rows stay no rows.
Columns scaled(Columns columns, const std::array<double, block_width>& factors);

/// Adds Σ_suns weight · irradiance of every realization ([R] columns) to `sums` ([R][N]).
void add_weighted(const std::vector<Columns>& of_realizations,
                  const std::array<double, block_width>& weights,
                  std::vector<std::vector<double>>& sums);

}  // namespace sunload
