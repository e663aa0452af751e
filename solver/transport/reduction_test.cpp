// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/transport/reduction_test.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "solver/base/chunks.h"
#include "solver/base/stopwatch.h"
#include "solver/light/instant_spread.h"

namespace sunload {

ReductionTest::ReductionTest(const TracedScene& traced, std::size_t band,
                             std::vector<IntervalLight> suns, WorkDone& work)
    : traced_(traced),
      optics_(traced.optics_of_band[band]),
      suns_(std::make_unique<const std::vector<IntervalLight>>(std::move(suns))),
      sources_(*suns_, static_cast<std::size_t>(traced.grid.cell_count())) {
  sources_.split_sky(traced.grid);
  RayLight rays = light_iteration(traced, sources_, {.columns = true}, {}, work).on_patches;
  const Stopwatch time(work[Work::solve_s]);
  rays_ = rays.pooled;
  rays_.circumsolar = {};
  keep_light(block_light(traced.hierarchy(), traced.patches.lines.pooled, optics_, sources_,
                         std::move(rays.pooled), traced.patches.lamps.pooled,
                         traced.bounce_rules(band)));
  InstantSpread spread(traced.patches.count(), suns_->size());
  SunColumns& of = rays.of_realizations;
  const std::size_t R = static_cast<std::size_t>(traced.rules.realizations);
  // Nodes make up the light of the sky and what is reflected: samples of the sun itself are those
  // of the interval, here as there, and their noise would hide what nodes do where there is less of
  // it.
  for (std::size_t r = 0; r < R; ++r) {
    if (has_circumsolar()) circumsolar_.emplace_back(of.circumsolar[r]);
    spread.add(total_of(block_light(
        traced.hierarchy(), traced.patches.lines.realizations[r], optics_, sources_,
        {rays_.direct, rays_.mirror, has_circumsolar() ? std::move(of.circumsolar[r]) : Columns()},
        traced.patches.lamps.of(r), traced.bounce_rules(band))));
  }
  standard_error_ = spread.errors();
}

Squares ReductionTest::squares_of(const NodeLight& nodes) const {
  const auto weights = nodes.weights(
      *suns_, ledger_of_rays(traced_, optics_, rays_.direct, rays_.mirror, suns_->size()));
  RayLight rays;
  rays.pooled = rays_;
  const BlockLight made = nodes.light(traced_.patches, &NodeBlock::patches, weights, rays);
  const std::vector<float> noise = noise_of_samples(nodes, weights);
  const std::vector<double>& area = traced_.hierarchy().area();
  const double all = std::accumulate(area.begin(), area.end(), 0.0);
  const OfIntervals each = ordered_sum(area.size(), receivers_per_chunk, OfIntervals{},
                                       [&](std::size_t begin, std::size_t end) {
                                         OfIntervals part;
                                         for (std::size_t i = begin; i < end; ++i)
                                           add_squares(made, noise, i, part);
                                         return part;
                                       });
  Squares sum;
  for (std::size_t k = 0; k < suns_->size(); ++k) {
    sum += each.of[k];
    const double error = each.of[k].error / all;
    sum.error2 += error * error;
  }
  for (double* square : {&sum.sky, &sum.reflected, &sum.error, &sum.standard_error})
    *square = std::max(0.0, *square / all);
  return sum;
}

/// Of patch i, by its area.
void ReductionTest::add_squares(const BlockLight& made, const std::vector<float>& noise,
                                std::size_t i, OfIntervals& sums) const {
  const std::vector<double>& area = traced_.hierarchy().area();
  for (std::size_t k = 0; k < suns_->size(); ++k) {
    Squares& sum = sums.of[k];
    const std::size_t at = i * block_width + k, row = k * area.size() + i;
    const auto sky = static_cast<double>(made.sky[at] + made.mirror[at] - sky_[at] - mirror_[at]);
    const auto noisy = static_cast<double>(noise[row]);
    const auto reflected = static_cast<double>(made.reflected[at] - reflected_[at]);
    sum.sky += area[i] * (sky * sky - noisy * noisy);
    sum.reflected += area[i] * reflected * reflected;
    sum.error += area[i] * ((sky + reflected) * (sky + reflected) - noisy * noisy);
    const auto se = static_cast<double>(standard_error_[row]);
    sum.standard_error += area[i] * se * se;
  }
}

void ReductionTest::keep_light(BlockLight exact) {
  sky_ = std::move(exact.sky);
  mirror_ = std::move(exact.mirror);
  reflected_ = std::move(exact.reflected);
}

/// Standard error of what nodes and test differ by, by their samples of the sky about the sun,
/// [interval][patch]: both solutions have it, and it says nothing of the nodes.
std::vector<float> ReductionTest::noise_of_samples(const NodeLight& nodes,
                                                   const std::vector<NodeWeights>& weights) const {
  if (!has_circumsolar()) return std::vector<float>(standard_error_.size(), 0);
  InstantSpread spread(traced_.patches.count(), suns_->size());
  for (std::size_t r = 0; r < circumsolar_.size(); ++r) {
    Columns difference = columns(traced_.patches.count());
    nodes.add_circumsolar(weights, r, difference);
    spread.add([&](std::size_t i, std::size_t k) {
      return difference[i * block_width + k] - circumsolar_[r].at(i, k);
    });
  }
  return spread.errors();
}

}  // namespace sunload
