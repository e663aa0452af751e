// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/transport/exact_totals.h"

#include <algorithm>

#include "solver/base/chunks.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

double mean_of_realizations(const ReceiverTally& tally, std::size_t i) {
  double sum = 0;
  for (const auto& of_one : tally.exposure_realization) sum += of_one[i];
  return sum / static_cast<double>(tally.exposure_realization.size());
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
    std::vector<double> more(end - begin, 0);  // of reflected light, as a share of it
    for (std::size_t i = begin; i < end; ++i) {
      const double missing = mean_of_realizations(tally, i) - total_sum[i];
      if (reflected_sum[i] > 0) more[i - begin] = std::max(missing / reflected_sum[i], -1.0);
      tally.irradiance_max[i] = 0;
    }
    for (const Reflected& block : blocks_)
      for (std::size_t k = 0; k < block.rows.size(); ++k) {
        const std::size_t row = block.rows[k];
        for (std::size_t i = begin; i < end; ++i) {
          const auto by = static_cast<float>(more[i - begin] *
                                             static_cast<double>((block.*of_receivers).at(i, k)));
          float& E = total[row * receivers + i];
          const float before = E;
          E = std::max(0.0f, before + by);
          tally.irradiance_max[i] = std::max(tally.irradiance_max[i], E);
          const double joules =
              (static_cast<double>(E) - static_cast<double>(before)) * block.length_s[k];
          changed[i] += joules;
          if (!reflected.empty())
            reflected[row * receivers + i] = std::max(0.0f, reflected[row * receivers + i] + by);
          for (PartTally& part : tally.parts)
            if (!part.total.empty()) part.total[i] += part.share[row] * joules;
        }
      }
    for (std::size_t i = begin; i < end; ++i) {
      total_sum[i] += changed[i];
      reflected_sum[i] = std::max(0.0, reflected_sum[i] + changed[i]);
    }
  });
}

}  // namespace sunload
