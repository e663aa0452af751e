// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/gather/block_tally.h"

#include <algorithm>
#include <array>
#include <limits>

#include "geo/base/check.h"
#include "geo/base/vector_code.h"
#include "solver/base/chunks.h"
#include "solver/base/threads.h"

namespace sunload {

namespace {

/// No estimator adds a term below 0.
constexpr float most_light = std::numeric_limits<float>::max();
/// Shares of several suns add up to all of them but for roundings of single precision.
constexpr float most_share = 1 + 1e-4f;

constexpr std::size_t chunk = receivers_per_chunk;
/// Of receivers that follow each other, row by row.
using Rows = std::array<float, chunk * block_width>;
using Joules = std::array<double, chunk>;
/// Of the intervals of a block, 0 beyond it.
using OfIntervals = std::array<double, block_width>;

// Loops over a block stay loops: the compiler makes them scalar where it unrolls them.

/// Values of the first `count` columns that are none of 0 … most.
SUNLOAD_VECTOR_CODE int unsound(const float* __restrict values, std::size_t rows, std::size_t count,
                                float most) {
  int found = 0;
  for (std::size_t i = 0; i < rows; ++i, values += block_width)
#pragma GCC unroll 1
    for (std::size_t k = 0; k < count; ++k) found += values[k] >= 0 && values[k] <= most ? 0 : 1;
  return found;
}

/// All kinds of light together.
SUNLOAD_VECTOR_CODE void add_kinds(const float* __restrict direct, const float* __restrict sky,
                                   const float* __restrict mirror, const float* __restrict lamps,
                                   const float* __restrict reflected, std::size_t rows,
                                   float* __restrict total) {
  for (std::size_t i = 0; i < rows; ++i)
#pragma GCC unroll 1
    for (std::size_t k = 0; k < block_width; ++k) {
      const std::size_t at = i * block_width + k;
      total[at] = direct[at] + sky[at] + mirror[at] + lamps[i] + reflected[at];
    }
}

/// Adds values times times, row by row; products are added two by two, whatever the width of
/// vectors.
SUNLOAD_VECTOR_CODE void add_time_sums(const float* __restrict values, std::size_t rows,
                                       const double* __restrict times, double* __restrict sums) {
  alignas(64) double of_lanes[block_width];
  for (std::size_t i = 0; i < rows; ++i, values += block_width) {
#pragma GCC unroll 1
    for (std::size_t k = 0; k < block_width; ++k)
      of_lanes[k] = static_cast<double>(values[k]) * times[k];
    for (std::size_t k = 0; k < 8; ++k) of_lanes[k] += of_lanes[k + 8];
    for (std::size_t k = 0; k < 4; ++k) of_lanes[k] += of_lanes[k + 4];
    sums[i] += (of_lanes[0] + of_lanes[2]) + (of_lanes[1] + of_lanes[3]);
  }
}

SUNLOAD_VECTOR_CODE void take_largest(const float* __restrict values, std::size_t rows,
                                      float* __restrict largest) {
  for (std::size_t i = 0; i < rows; ++i, values += block_width) {
    float most = largest[i];
#pragma GCC unroll 1
    for (std::size_t k = 0; k < block_width; ++k) most = values[k] > most ? values[k] : most;
    largest[i] = most;
  }
}

SUNLOAD_VECTOR_CODE void at_most_one(const float* __restrict values, std::size_t count,
                                     float* __restrict cut) {
  for (std::size_t at = 0; at < count; ++at) cut[at] = values[at] < 1 ? values[at] : 1.0f;
}

/// A part of the period, and how much of the block's intervals belongs to it.
struct PartOfBlock {
  PartTally* tally;
  OfIntervals length_s{}, sunlit_s{};
};

/// Parts to which some of the block belongs.
std::vector<PartOfBlock> parts_of_block(std::span<const IntervalLight> block,
                                        std::span<const std::size_t> rows,
                                        std::vector<PartTally>& parts) {
  std::vector<PartOfBlock> of_block;
  for (PartTally& part : parts) {
    PartOfBlock some{&part, {}, {}};
    bool any = false;
    for (std::size_t k = 0; k < block.size(); ++k) {
      some.length_s[k] = part.share[rows[k]] * block[k].length_s;
      some.sunlit_s[k] = part.share[rows[k]] * block[k].sunlit_s;
      any = any || some.length_s[k] != 0;
    }
    if (any) of_block.push_back(some);
  }
  return of_block;
}

/// What a block brings to receivers, and the tally that it goes to.
class StoredBlock {
 public:
  StoredBlock(const BlockLight& light, std::span<const IntervalLight> block,
              std::span<const std::size_t> rows, const Columns& sunlit, ReceiverTally& tally)
      : light_(light),
        intervals_(rows),
        sunlit_(sunlit),
        tally_(tally),
        parts_(parts_of_block(block, rows, tally.parts)) {
    for (std::size_t k = 0; k < block.size(); ++k) {
      length_s_[k] = block[k].length_s;
      sunlit_s_[k] = block[k].sunlit_s;
    }
  }

  /// Stores what a chunk from receiver `begin` to `end` gets; its light of all kinds is added to
  /// `total`.
  void store(std::size_t begin, std::size_t end, Joules& total) {
    const std::size_t at = begin * block_width, rows = end - begin;
    Rows of_all, seen, of_lamps;
    add_kinds(&light_.direct[at], &light_.sky[at], &light_.mirror[at], &light_.lamps[begin],
              &light_.reflected[at], rows, of_all.data());
    expect_sound(begin, rows, of_all);
    for (std::size_t i = 0; i < rows; ++i)
      std::fill_n(&of_lamps[i * block_width], block_width, light_.lamps[begin + i]);
    put(Part::total, begin, rows, of_all.data());
    put(Part::direct, begin, rows, &light_.direct[at]);
    put(Part::sky, begin, rows, &light_.sky[at]);
    put(Part::mirror, begin, rows, &light_.mirror[at]);
    put(Part::lamps, begin, rows, of_lamps.data());
    put(Part::reflected, begin, rows, &light_.reflected[at]);
    add_time_sums(of_all.data(), rows, length_s_.data(), total.data());
    at_most_one(&sunlit_[at], rows * block_width, seen.data());
    add_time_sums(seen.data(), rows, sunlit_s_.data(), &tally_.sunlit_s[begin]);
    take_largest(of_all.data(), rows, &tally_.irradiance_max[begin]);
    for (PartOfBlock& part : parts_) {
      add_to_part(part.tally->total, begin, rows, of_all.data(), part.length_s);
      add_to_part(part.tally->direct, begin, rows, &light_.direct[at], part.length_s);
      add_to_part(part.tally->sunlit_s, begin, rows, seen.data(), part.sunlit_s);
    }
  }

 private:
  void expect_sound(std::size_t begin, std::size_t rows, const Rows& of_all) const {
    const std::size_t at = begin * block_width, count = intervals_.size();
    int of_light = unsound(of_all.data(), rows, count, most_light);
    for (const Columns* part : {&light_.direct, &light_.sky, &light_.mirror, &light_.reflected})
      of_light += unsound(&(*part)[at], rows, count, most_light);
    for (std::size_t i = begin; i < begin + rows; ++i)
      of_light += light_.lamps[i] >= 0 && light_.lamps[i] <= most_light ? 0 : 1;
    SUNLOAD_EXPECT(of_light == 0, "light that is a number and not below 0");
    SUNLOAD_EXPECT(unsound(&sunlit_[at], rows, count, most_share) == 0,
                   "no more suns seen than there are");
  }
  void put(Part part, std::size_t begin, std::size_t rows, const float* values) {
    const auto p = static_cast<std::size_t>(part);
    if (tally_.exposure[p].empty()) return;
    add_time_sums(values, rows, length_s_.data(), &tally_.exposure[p][begin]);
    if (tally_.irradiance[p].empty()) return;
    const std::size_t receivers = tally_.sunlit_s.size();
    for (std::size_t k = 0; k < intervals_.size(); ++k) {
      float* const series = &tally_.irradiance[p][intervals_[k] * receivers + begin];
      for (std::size_t i = 0; i < rows; ++i) series[i] = values[i * block_width + k];
    }
  }
  static void add_to_part(std::vector<double>& sums, std::size_t begin, std::size_t rows,
                          const float* values, const OfIntervals& times) {
    if (!sums.empty()) add_time_sums(values, rows, times.data(), &sums[begin]);
  }

  const BlockLight& light_;
  std::span<const std::size_t> intervals_;  ///< rows of the series
  const Columns& sunlit_;
  ReceiverTally& tally_;
  std::vector<PartOfBlock> parts_;
  OfIntervals length_s_{}, sunlit_s_{};
};

}  // namespace

void store_received(const BlockLight& light, std::span<const IntervalLight> block,
                    std::span<const std::size_t> rows, const Columns& sunlit,
                    ReceiverTally& tally) {
  StoredBlock stored(light, block, rows, sunlit, tally);
  parallel_chunks(tally.sunlit_s.size(), chunk, [&](std::size_t begin, std::size_t end) {
    Joules total{};
    stored.store(begin, end, total);
  });
}

void store_patches(const PatchOptics& optics, const BlockLight& light,
                   std::span<const IntervalLight> block, std::span<const std::size_t> rows,
                   const Columns& sunlit, BatchTally& tally) {
  StoredBlock stored(light, block, rows, sunlit, tally);
  double length_s = 0;
  for (const IntervalLight& interval : block) length_s += interval.length_s;
  parallel_chunks(tally.outgoing.size(), chunk, [&](std::size_t begin, std::size_t end) {
    Joules total{};
    stored.store(begin, end, total);
    for (std::size_t i = begin; i < end; ++i)
      tally.outgoing[i] += static_cast<double>(optics.diffuse[i]) * total[i - begin] +
                           static_cast<double>(optics.emission[i]) * length_s;
  });
}

}  // namespace sunload
