// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/solver.h"

#include <algorithm>

namespace sunload {

namespace {

BatchTally tally_of(const TracedScene& traced, std::size_t intervals,
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
  return empty_tally(shape);
}

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

Solved solve(const LightTransport& transport, std::span<const IntervalLight> batch, Watch& watch,
             std::span<const PartOfBatch> parts, RayRecord* record) {
  const TracedScene& traced = transport.traced();
  Solved solved;
  for (std::size_t b = 0; b < traced.optics_of_band.size(); ++b)
    solved.bands.push_back(tally_of(traced, batch.size(), parts));
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

}  // namespace sunload
