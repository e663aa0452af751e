// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/gather/block_tally.h"

#include <algorithm>
#include <cmath>

#include "geo/base/check.h"
#include "solver/base/chunks.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

/// No estimator adds a term below 0.
bool is_light(float irradiance) { return irradiance >= 0 && std::isfinite(irradiance); }

/// Shares of several suns add up to all of them but for roundings of single precision.
bool is_share(float sunlit) {
  constexpr float roundings = 1e-4f;
  return sunlit >= 0 && sunlit <= 1 + roundings;
}

/// Adds what receiver i gets of sun k of the block to the parts that the interval belongs to.
void add_to_parts(const BlockLight& light, const IntervalLight& sun, std::size_t interval,
                  std::size_t i, std::size_t k, double sunlit, std::vector<PartTally>& parts) {
  for (PartTally& part : parts) {
    const double time = part.share[interval] * sun.length_s;
    if (time == 0) continue;
    if (!part.total.empty()) part.total[i] += static_cast<double>(light.total(i, k)) * time;
    if (!part.direct.empty())
      part.direct[i] += static_cast<double>(light.direct[i * block_width + k]) * time;
    part.sunlit_s[i] += part.share[interval] * sunlit * sun.sunlit_s;
  }
}

}  // namespace

void store_received(const BlockLight& light, std::span<const IntervalLight> block,
                    std::span<const std::size_t> rows, const Columns& sunlit,
                    ReceiverTally& tally) {
  const std::size_t receivers = tally.sunlit_s.size();
  const auto put = [&](Part part, std::size_t i, std::size_t k, float value) {
    const auto p = static_cast<std::size_t>(part);
    if (tally.exposure[p].empty()) return;
    if (!tally.irradiance[p].empty()) tally.irradiance[p][rows[k] * receivers + i] = value;
    tally.exposure[p][i] += static_cast<double>(value) * block[k].length_s;
  };
  parallel_for(
      receivers,
      [&](std::size_t i) {
        for (std::size_t k = 0; k < block.size(); ++k) {
          const std::size_t at = i * block_width + k;
          const float total = light.total(i, k);
          SUNLOAD_EXPECT(is_light(total) && is_light(light.direct[at]) && is_light(light.sky[at]) &&
                             is_light(light.mirror[at]) && is_light(light.lamps[i]) &&
                             is_light(light.reflected[at]),
                         "light that is a number and not below 0");
          SUNLOAD_EXPECT(is_share(sunlit[at]), "no more suns seen than there are");
          put(Part::total, i, k, total);
          put(Part::direct, i, k, light.direct[at]);
          put(Part::sky, i, k, light.sky[at]);
          put(Part::mirror, i, k, light.mirror[at]);
          put(Part::lamps, i, k, light.lamps[i]);
          put(Part::reflected, i, k, light.reflected[at]);
          const double seen = std::min(1.0, static_cast<double>(sunlit[at]));
          tally.sunlit_s[i] += seen * block[k].sunlit_s;
          tally.irradiance_max[i] = std::max(tally.irradiance_max[i], total);
          add_to_parts(light, block[k], rows[k], i, k, seen, tally.parts);
        }
      },
      receivers_per_chunk);
}

void store_patches(const PatchOptics& optics, const BlockLight& light,
                   std::span<const IntervalLight> block, std::span<const std::size_t> rows,
                   const Columns& sunlit, BatchTally& tally) {
  store_received(light, block, rows, sunlit, tally);
  parallel_for(
      tally.outgoing.size(),
      [&](std::size_t i) {
        for (std::size_t k = 0; k < block.size(); ++k)
          tally.outgoing[i] +=
              static_cast<double>(optics.diffuse[i] * light.total(i, k) + optics.emission[i]) *
              block[k].length_s;
      },
      receivers_per_chunk);
}

}  // namespace sunload
