// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/transport/exact_totals.h"

#include <algorithm>
#include <array>

#include "geo/base/vector_code.h"
#include "solver/base/chunks.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

double mean_of_realizations(const ReceiverTally& tally, std::size_t i) {
  double sum = 0;
  for (const auto& of_one : tally.exposure_realization) sum += of_one[i];
  return sum / static_cast<double>(tally.exposure_realization.size());
}

/// Values of consecutive receivers.
template <class T>
using OfChunk = std::array<T, receivers_per_chunk>;

/// What reflected light changes by, [suns of a block][receivers of a chunk].
using Changes = std::array<OfChunk<float>, block_width>;

/// `more`: of reflected light, as a share of it.
void changes_of(const PackedColumns& reflected, const OfChunk<float>& more, std::size_t begin,
                std::size_t count, Changes& by) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint16_t* codes = reflected.codes(begin + i);
    const float scale = more[i] * reflected.of_row(begin + i);
    for (std::size_t k = 0; k < block_width; ++k)
      by[k][i] = static_cast<float>(codes[k]) * (scale * reflected.of_column(k));
  }
}

/// Changes light of one interval; nothing falls below 0. `changed`: by how much [J m-2]; `most`:
/// the largest value up to now.
SUNLOAD_VECTOR_CODE void change(float* __restrict E, const float* __restrict by, float length_s,
                                std::size_t count, float* __restrict changed,
                                float* __restrict most) {
  for (std::size_t i = 0; i < count; ++i) {
    const float before = E[i], sum = before + by[i], after = sum > 0 ? sum : 0;
    E[i] = after;
    changed[i] = (after - before) * length_s;
    most[i] = after > most[i] ? after : most[i];
  }
}

SUNLOAD_VECTOR_CODE void add(const float* __restrict values, double times, std::size_t count,
                             double* __restrict to) {
  for (std::size_t i = 0; i < count; ++i) to[i] += times * static_cast<double>(values[i]);
}

}  // namespace

void ExactTotals::keep(const Block& block, const Columns& patches, const Columns* sensors) {
  Reflected reflected{.rows = {block.rows.begin(), block.rows.end()},
                      .length_s = {},
                      .patches = PackedColumns(patches),
                      .sensors = sensors ? PackedColumns(*sensors) : PackedColumns()};
  for (const IntervalLight& sun : block.suns) reflected.length_s.push_back(sun.length_s);
  blocks_.push_back(std::move(reflected));
}

void ExactTotals::take(const PatchOptics& optics, BatchTally& tally) const {
  std::vector<double> changed;
  take(&Reflected::patches, tally, changed);
  for (std::size_t i = 0; i < tally.outgoing.size(); ++i)
    tally.outgoing[i] += static_cast<double>(optics.diffuse[i]) * changed[i];
  take(&Reflected::sensors, tally.sensors, changed);
}

/// `changed`: what sums change by, of every receiver [J m-2].
void ExactTotals::take(PackedColumns Reflected::*of_receivers, ReceiverTally& tally,
                       std::vector<double>& changed) const {
  const std::size_t receivers = tally.sunlit_s.size();
  LargeVector<float>& total = tally.irradiance[static_cast<std::size_t>(Part::total)];
  LargeVector<float>& reflected = tally.irradiance[static_cast<std::size_t>(Part::reflected)];
  std::vector<double>& total_sum = tally.exposure[static_cast<std::size_t>(Part::total)];
  std::vector<double>& reflected_sum = tally.exposure[static_cast<std::size_t>(Part::reflected)];
  changed.assign(receivers, 0);
  if (receivers == 0 || reflected_sum.empty() || tally.exposure_realization.empty()) return;
  parallel_chunks(receivers, receivers_per_chunk, [&](std::size_t begin, std::size_t end) {
    const std::size_t count = end - begin;
    OfChunk<float> more{}, joules;
    for (std::size_t i = begin; i < end; ++i) {
      const double missing = mean_of_realizations(tally, i) - total_sum[i];
      if (reflected_sum[i] > 0)
        more[i - begin] = static_cast<float>(std::max(missing / reflected_sum[i], -1.0));
      tally.irradiance_max[i] = 0;
    }
    Changes by;
    for (const Reflected& block : blocks_) {
      changes_of(block.*of_receivers, more, begin, count, by);
      for (std::size_t k = 0; k < block.rows.size(); ++k) {
        const std::size_t row = block.rows[k], first = row * receivers + begin;
        change(&total[first], by[k].data(), static_cast<float>(block.length_s[k]), count,
               joules.data(), &tally.irradiance_max[begin]);
        add(joules.data(), 1, count, &changed[begin]);
        for (PartTally& part : tally.parts)
          if (!part.total.empty() && part.share[row] > 0)
            add(joules.data(), part.share[row], count, &part.total[begin]);
        if (reflected.empty()) continue;
        for (std::size_t i = 0; i < count; ++i)
          reflected[first + i] = std::max(0.0f, reflected[first + i] + by[k][i]);
      }
    }
    for (std::size_t i = begin; i < end; ++i) {
      total_sum[i] += changed[i];
      reflected_sum[i] = std::max(0.0, reflected_sum[i] + changed[i]);
    }
  });
}

}  // namespace sunload
