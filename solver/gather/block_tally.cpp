// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/gather/block_tally.h"

#include <algorithm>
#include <array>
#include <limits>

#include "geo/base/check.h"
#include "solver/base/chunks.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

/// No estimator adds a term below 0.
constexpr float most_light = std::numeric_limits<float>::max();
/// Shares of several suns add up to all of them but for roundings of single precision.
constexpr float most_share = 1 + 1e-4f;

/// Values that are none of 0 … most.
int unsound(const float* values, std::size_t count, float most) {
  int found = 0;
  for (std::size_t k = 0; k < count; ++k) found += values[k] >= 0 && values[k] <= most ? 0 : 1;
  return found;
}

/// What one receiver gets in the intervals of a block.
struct Row {
  std::array<float, block_width> total{};
  const float *direct, *sky, *mirror, *reflected, *sunlit;
  float lamps;

  Row(const BlockLight& light, const Columns& of_sunlit, std::size_t i, std::size_t count)
      : direct(&light.direct[i * block_width]),
        sky(&light.sky[i * block_width]),
        mirror(&light.mirror[i * block_width]),
        reflected(&light.reflected[i * block_width]),
        sunlit(&of_sunlit[i * block_width]),
        lamps(light.lamps[i]) {
    for (std::size_t k = 0; k < count; ++k) total[k] = light.total(i, k);
  }
};

/// Adds what receiver i gets of sun k of the block to the parts that the interval belongs to.
void add_to_parts(const Row& row, const IntervalLight& sun, std::size_t interval, std::size_t i,
                  std::size_t k, double sunlit, std::vector<PartTally>& parts) {
  for (PartTally& part : parts) {
    const double time = part.share[interval] * sun.length_s;
    if (time == 0) continue;
    if (!part.total.empty()) part.total[i] += static_cast<double>(row.total[k]) * time;
    if (!part.direct.empty()) part.direct[i] += static_cast<double>(row.direct[k]) * time;
    part.sunlit_s[i] += part.share[interval] * sunlit * sun.sunlit_s;
  }
}

void expect_sound(const Row& row, std::size_t count) {
  int of_light = unsound(&row.lamps, 1, most_light);
  for (const float* part : {row.total.data(), row.direct, row.sky, row.mirror, row.reflected})
    of_light += unsound(part, count, most_light);
  SUNLOAD_EXPECT(of_light == 0, "light that is a number and not below 0");
  SUNLOAD_EXPECT(unsound(row.sunlit, count, most_share) == 0, "no more suns seen than there are");
}

}  // namespace

void store_received(const BlockLight& light, std::span<const IntervalLight> block,
                    std::span<const std::size_t> rows, const Columns& sunlit,
                    ReceiverTally& tally) {
  const std::size_t receivers = tally.sunlit_s.size(), count = block.size();
  std::array<double, block_width> length_s{}, sunlit_s{};
  for (std::size_t k = 0; k < count; ++k) {
    length_s[k] = block[k].length_s;
    sunlit_s[k] = block[k].sunlit_s;
  }
  // Sums are kept beside the tally while a row is added: what is written there might else be what
  // is read next.
  const auto put = [&](Part part, std::size_t i, const float* values) {
    const auto p = static_cast<std::size_t>(part);
    if (tally.exposure[p].empty()) return;
    if (!tally.irradiance[p].empty())
      for (std::size_t k = 0; k < count; ++k)
        tally.irradiance[p][rows[k] * receivers + i] = values[k];
    double sum = tally.exposure[p][i];
    for (std::size_t k = 0; k < count; ++k) sum += static_cast<double>(values[k]) * length_s[k];
    tally.exposure[p][i] = sum;
  };
  parallel_for(
      receivers,
      [&](std::size_t i) {
        const Row row(light, sunlit, i, count);
        expect_sound(row, count);
        std::array<float, block_width> lamps;
        lamps.fill(row.lamps);
        put(Part::total, i, row.total.data());
        put(Part::direct, i, row.direct);
        put(Part::sky, i, row.sky);
        put(Part::mirror, i, row.mirror);
        put(Part::lamps, i, lamps.data());
        put(Part::reflected, i, row.reflected);
        double seen_s = tally.sunlit_s[i];
        float most = tally.irradiance_max[i];
        for (std::size_t k = 0; k < count; ++k) {
          const double seen = std::min(1.0, static_cast<double>(row.sunlit[k]));
          seen_s += seen * sunlit_s[k];
          most = std::max(most, row.total[k]);
          add_to_parts(row, block[k], rows[k], i, k, seen, tally.parts);
        }
        tally.sunlit_s[i] = seen_s;
        tally.irradiance_max[i] = most;
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
        const float diffuse = optics.diffuse[i], emission = optics.emission[i];
        double sum = tally.outgoing[i];
        for (std::size_t k = 0; k < block.size(); ++k)
          sum += static_cast<double>(diffuse * light.total(i, k) + emission) * block[k].length_s;
        tally.outgoing[i] = sum;
      },
      receivers_per_chunk);
}

}  // namespace sunload
