// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/solver.h"

#include <algorithm>
#include <cmath>

#include "geo/base/units.h"

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

/// Places in the batch of intervals with light (emitters shine always), those whose suns stand
/// close together side by side: what one of them sees, the others nearly do.
std::vector<std::size_t> lit_rows(const TracedScene& traced, std::span<const IntervalLight> batch) {
  std::vector<std::size_t> rows;
  for (std::size_t k = 0; k < batch.size(); ++k)
    if (traced.optics.any_emission || !batch[k].is_dark()) rows.push_back(k);
  const auto azimuth = [&](std::size_t k) {
    constexpr double behind_all = 2 * pi;
    return batch[k].has_sun() ? place_in_batch(batch[k].direction) : behind_all;
  };
  std::stable_sort(rows.begin(), rows.end(),
                   [&](auto a, auto b) { return azimuth(a) < azimuth(b); });
  return rows;
}

/// Light that is solved is looked at with its block; this is what is left out.
void expect_dark_valid(const TracedScene& traced, std::span<const IntervalLight> batch) {
  for (std::size_t k = 0; k < batch.size(); ++k)
    if (batch[k].is_dark())
      expect_valid(batch.subspan(k, 1), static_cast<std::size_t>(traced.grid.cell_count()));
}

/// Time sums of the ledger's series.
void add_energy(std::span<const IntervalLight> batch, BatchTally& tally) {
  for (std::size_t k = 0; k < batch.size(); ++k)
    tally.energy += scaled(tally.ledger[k], batch[k].length_s);
}

}  // namespace

int batch_suns_for(std::size_t intervals) {
  // A batch is lost with the process that has it in hand: there are some of them in any case.
  constexpr std::size_t weeks = 256, months = 1024;
  return intervals > months ? 256 : intervals > weeks ? 128 : 64;
}

Solved solve(const LightTransport& transport, std::span<const IntervalLight> batch, Watch& watch,
             std::span<const PartOfBatch> parts, RayRecord* record) {
  const TracedScene& traced = transport.traced();
  expect_dark_valid(traced, batch);
  Solved solved;
  for (std::size_t b = 0; b < traced.optics_of_band.size(); ++b)
    solved.bands.push_back(empty_tally(tally_shape(traced, batch.size(), parts)));
  const auto in_batch = transport.begin(solved.bands, solved.work, record);
  const std::vector<std::size_t> rows = lit_rows(traced, batch);
  std::vector<IntervalLight> suns;
  for (std::size_t done = 0; done < rows.size();) {
    const auto of_block = std::span(rows).subspan(done, std::min(block_width, rows.size() - done));
    suns.clear();
    for (const auto row : of_block) suns.push_back(batch[row]);
    const double rays_before = solved.work.rays();
    in_batch->light({suns, of_block});  // E = E_0 + G rho E
    done += of_block.size();
    watch.cast(solved.work.rays() - rays_before);
    watch.advance(Stage::light, static_cast<double>(done) / static_cast<double>(rows.size()));
  }
  if (rows.empty()) watch.advance(Stage::light, 1);
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
