// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/solver.h"

#include <algorithm>

namespace sunload {

TallyShape tally_shape(const TracedScene& traced, std::size_t intervals,
                       std::span<const PartOfBatch> parts) {
  TallyShape shape{.patches = traced.patches.count(),
                   .sensors = traced.sensors.count(),
                   .intervals = intervals,
                   .realizations = static_cast<std::size_t>(traced.rules.realizations),
                   .parts = {},
                   .series = traced.rules.series,
                   .errors = traced.rules.errors,
                   .by_source = traced.rules.by_source,
                   .transport = traced.rules.transport,
                   .periods = {parts.begin(), parts.end()}};
  for (std::size_t p = 0; p < part_count; ++p)
    shape.parts[p] = traced.has_part(static_cast<Part>(p));
  return shape;
}

namespace {

/// Consecutive intervals with light, up to `block_width` side by side. Emitters shine always.
std::vector<Block> lit_blocks(const TracedScene& traced, std::span<const IntervalLight> batch) {
  const auto is_lit = [&](const IntervalLight& sun) {
    return traced.optics.any_emission || !sun.is_dark();
  };
  std::vector<Block> blocks;
  for (std::size_t begin = 0; begin < batch.size();) {
    std::size_t end = begin;
    while (end < std::min(batch.size(), begin + block_width) && is_lit(batch[end])) ++end;
    if (end > begin) blocks.push_back({batch.subspan(begin, end - begin), begin});
    begin = std::max(end, begin + 1);
  }
  return blocks;
}

/// Time sums of the ledger's series.
void add_energy(std::span<const IntervalLight> batch, BatchTally& tally) {
  for (std::size_t k = 0; k < batch.size(); ++k)
    tally.energy += scaled(tally.ledger[k], batch[k].length_s);
}

}  // namespace

int batch_suns_for(std::size_t intervals) {
  constexpr std::size_t long_period = 2048;
  return intervals > long_period ? 256 : 64;
}

Solved solve(const LightTransport& transport, std::span<const IntervalLight> batch, Watch& watch,
             std::span<const PartOfBatch> parts, RayRecord* record) {
  const TracedScene& traced = transport.traced();
  Solved solved;
  for (std::size_t b = 0; b < traced.optics_of_band.size(); ++b)
    solved.bands.push_back(empty_tally(tally_shape(traced, batch.size(), parts)));
  const auto in_batch = transport.begin(solved.bands, solved.work, record);
  std::size_t done = 0;
  for (const Block& block : lit_blocks(traced, batch)) {
    const double rays_before = solved.work.rays();
    in_batch->light(block);  // E = E_0 + G rho E
    done = block.first_row + block.suns.size();
    watch.cast(solved.work.rays() - rays_before);
    watch.advance(Stage::light, static_cast<double>(done) / static_cast<double>(batch.size()));
  }
  if (done < batch.size()) watch.advance(Stage::light, 1);  // the rest is dark
  for (BatchTally& tally : solved.bands) add_energy(batch, tally);
  in_batch->finish();
  return solved;
}

namespace {

/// What is left of the batch's parts in intervals [first, first + count).
std::vector<PartOfBatch> parts_within(std::span<const PartOfBatch> parts, std::size_t first,
                                      std::size_t count) {
  std::vector<PartOfBatch> within;
  for (const PartOfBatch& part : parts) {
    const auto begin = part.share.begin() + static_cast<std::ptrdiff_t>(first);
    within.push_back({{begin, begin + static_cast<std::ptrdiff_t>(count)}, part.with_errors});
  }
  return within;
}

}  // namespace

Solved solve_in_turns(std::span<const LightTransport* const> scenes,
                      std::span<const Stretch> stretches, std::span<const IntervalLight> batch,
                      Watch& watch, std::span<const PartOfBatch> parts) {
  const TracedScene& first_scene = scenes.front()->traced();
  TallyShape shape = tally_shape(first_scene, batch.size(), parts);
  for (const LightTransport* scene : scenes)
    for (std::size_t p = 0; p < part_count; ++p)
      shape.parts[p] = shape.parts[p] || scene->traced().has_part(static_cast<Part>(p));
  Solved whole;
  for (std::size_t b = 0; b < first_scene.optics_of_band.size(); ++b)
    whole.bands.push_back(empty_tally(shape));
  std::size_t first = 0;
  for (const Stretch& stretch : stretches) {
    const auto within = parts_within(parts, first, stretch.intervals);
    const Solved solved =
        solve(*scenes[stretch.scene], batch.subspan(first, stretch.intervals), watch, within);
    for (std::size_t b = 0; b < whole.bands.size(); ++b)
      put_stretch(solved.bands[b], first, whole.bands[b]);
    whole.work += solved.work;
    first += stretch.intervals;
  }
  return whole;
}

}  // namespace sunload
