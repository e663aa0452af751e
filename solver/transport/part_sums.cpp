// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/transport/part_sums.h"

#include <algorithm>
#include <utility>

#include "geo/base/units.h"
#include "solver/base/chunks.h"
#include "solver/base/threads.h"
#include "solver/gather/sensor_light.h"

namespace sunload {

namespace {

bool any(const std::vector<double>& shares) {
  return std::any_of(shares.begin(), shares.end(), [](double share) { return share > 0; });
}

}  // namespace

PartSums::PartSums(const TracedScene& traced, std::size_t band, BatchTally& tally)
    : traced_(traced), band_(band), tally_(tally) {
  for (std::size_t p = 0; p < tally.parts.size(); ++p)
    if (tally.parts[p].with_errors)
      parts_.push_back(
          {p,
           {static_cast<std::size_t>(traced.rules.realizations), traced.patches.count(),
            traced.sensors.count(), static_cast<std::size_t>(traced.grid.cell_count())}});
}

std::vector<double> PartSums::shares(std::size_t part, const Block& block) const {
  std::vector<double> of_suns;
  for (const auto row : block.rows) of_suns.push_back(tally_.parts[parts_[part].part].share[row]);
  return of_suns;
}

std::vector<TimedSums> PartSums::timed(const Block& block, TimeSums& whole) {
  std::vector<TimedSums> sums_in_block{{&whole, lengths_of(block.suns)}};
  for (std::size_t p = 0; p < count(); ++p) {
    const auto of_suns = shares(p, block);
    if (!any(of_suns)) continue;
    SunSeconds seconds = lengths_of(block.suns);
    for (std::size_t k = 0; k < of_suns.size(); ++k) seconds[k] *= of_suns[k];
    sums_in_block.push_back({&sums(p), seconds});
  }
  return sums_in_block;
}

std::vector<TimeSums*> PartSums::all(TimeSums& whole) {
  std::vector<TimeSums*> every{&whole};
  for (OfPart& part : parts_) every.push_back(&part.sums);
  return every;
}

void PartSums::add_sources(const Block& block, const BlockSources& sources, Sky sky) {
  for (std::size_t p = 0; p < count(); ++p) {
    const auto of_suns = shares(p, block);
    if (!any(of_suns)) continue;
    if (sky == Sky::split)
      sums(p).add_sources(sources, of_suns);
    else
      sums(p).add_whole_sources(sources, of_suns);
  }
}

void PartSums::add_rays(const Block& block, const BlockRays& rays, const BandFactors& factors) {
  for (std::size_t p = 0; p < count(); ++p) {
    const auto of_suns = shares(p, block);
    if (!any(of_suns)) continue;
    BandFactors of_part = factors;
    for (std::size_t k = 0; k < of_suns.size(); ++k) {
      of_part.sun[k] *= of_suns[k];
      of_part.circumsolar[k] *= of_suns[k];
    }
    add_exposures(rays, of_part, block.suns, sums(p));
  }
}

void PartSums::solve() {
  Parts block;
  for (const OfPart& of : parts_) {
    if (of.sums.length_s > 0) block.push_back(&of);
    if (block.size() == block_width || (&of == &parts_.back() && !block.empty())) {
      solve(block);
      block.clear();
    }
  }
}

void PartSums::solve(const Parts& block) {
  const PatchOptics& optics = traced_.optics_of_band[band_];
  const std::vector<IntervalLight> means = mean_lights(block);
  BlockSources sources(means, static_cast<std::size_t>(traced_.grid.cell_count()));
  for (std::size_t k = 0; k < block.size(); ++k)
    for (std::size_t c = 0; c < block[k]->sums.sky_of_lines.size(); ++c)
      sources.sky_of_lines[c * block_width + k] =
          static_cast<float>(block[k]->sums.sky_of_lines[c] / block[k]->sums.length_s);
  for (std::size_t r = 0; r < static_cast<std::size_t>(traced_.rules.realizations); ++r) {
    BlockLight light = block_light(traced_.hierarchy(), traced_.patches.lines.realizations[r],
                                   optics, sources, mean_rays(block, &TimeSums::on_patches, r),
                                   traced_.patches.lamps.of(r), traced_.bounce_rules(band_));
    keep(block, r, light, tally_);
    if (traced_.sensors.count() == 0) continue;
    RayColumns rays = mean_rays(block, &TimeSums::on_sensors, r);
    rays.circumsolar.clear();  // sensors see all of the sky by their lines
    keep(block, r,
         sensor_light(traced_.sensors.lines.realizations[r], optics, sources, std::move(rays),
                      traced_.sensors.lamps.of(r),
                      seen_radiosity(traced_.hierarchy(), optics, light)),
         tally_.sensors);
  }
}

std::vector<IntervalLight> PartSums::mean_lights(const Parts& block) {
  std::vector<IntervalLight> means(block.size());
  for (std::size_t k = 0; k < block.size(); ++k) {
    const TimeSums& sums = block[k]->sums;
    means[k].ground_exitance = sums.ground / sums.length_s;
    for (const double sky : sums.sky) means[k].sky.push_back(sky / (pi * sums.length_s));
  }
  return means;
}

RayColumns PartSums::mean_rays(const Parts& block, RaySums TimeSums::*of, std::size_t r) {
  const auto means = [&](std::vector<std::vector<double>> RaySums::*kind) {
    Columns mean = columns(((block.front()->sums.*of).*kind)[r].size());
    parallel_for(
        mean.size() / block_width,
        [&](std::size_t i) {
          for (std::size_t k = 0; k < block.size(); ++k)
            mean[i * block_width + k] =
                static_cast<float>(((block[k]->sums.*of).*kind)[r][i] / block[k]->sums.length_s);
        },
        receivers_per_chunk);
    return mean;
  };
  return {means(&RaySums::direct), means(&RaySums::mirror), means(&RaySums::circumsolar)};
}

void PartSums::keep(const Parts& block, std::size_t r, const BlockLight& light,
                    ReceiverTally& tally) {
  for (std::size_t k = 0; k < block.size(); ++k) {
    auto& exposure = tally.parts[block[k]->part].exposure_realization[r];
    parallel_for(
        exposure.size(),
        [&](std::size_t i) {
          exposure[i] = static_cast<double>(light.total(i, k)) * block[k]->sums.length_s;
        },
        receivers_per_chunk);
  }
}

}  // namespace sunload
