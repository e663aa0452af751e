// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What rays bring to one set of receivers, patches or sensors, in a block of suns: E_0 but for
/// what comes by lines.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "solver/light/sun_block.h"

namespace sunload {

/// Irradiance of N receivers, [N][block] W m-2.
struct RayColumns {
  Columns direct;       ///< of the sun, straight
  Columns mirror;       ///< of the sun, by mirrors and gloss
  Columns circumsolar;  ///< of the sky about the sun; empty: the lines take the whole sky
};

/// The same of every realization, [R]; empty where neither errors per instant nor bands are asked
/// for.
struct SunColumns {
  std::vector<Columns> direct, mirror, circumsolar;
  SunColumns() = default;
  SunColumns(std::size_t realizations, std::size_t receivers)
      : direct(realizations, columns(receivers)), mirror(direct), circumsolar(direct) {}
};
/// The sum of all columns of each realization.
std::vector<Columns> summed(const SunColumns& columns);

/// Seconds that each sun of a block counts.
using SunSeconds = std::array<double, block_width>;
/// Its whole interval.
SunSeconds lengths_of(std::span<const IntervalLight> block);

/// Irradiance that is added up over time into `exposure`, [R][N] J m-2.
struct TimeIntegral {
  std::vector<std::vector<double>>* exposure;
  SunSeconds seconds;
};

/// Where one kind of rays leaves what it brings to N receivers: pooled, and where they are wanted
/// time integrals and columns of every realization.
class RaySink {
 public:
  /// `of_realizations`: [R] columns, or null or none. All of them must outlive it, and have room.
  RaySink(Columns& pooled, std::size_t realizations, std::vector<TimeIntegral> integrals = {},
          std::vector<Columns>* of_realizations = nullptr)
      : pooled_(pooled),
        realizations_(realizations),
        integrals_(std::move(integrals)),
        of_realizations_(of_realizations && !of_realizations->empty() ? of_realizations : nullptr) {
  }

  std::size_t realizations() const { return realizations_; }
  /// The same for suns that all are parts of sun k of these.
  RaySink of_parts_of(std::size_t k) const {
    RaySink parts = *this;
    parts.whole_ = k;
    return parts;
  }
  /// The sun of the block that sun k is, or is a part of.
  std::size_t whole_of(std::size_t k) const { return whole_ == every_one ? k : whole_; }
  /// Adds irradiance E [W m-2] by sun k of the block, as one realization has it; the pooled one is
  /// for the caller to add.
  void add(std::size_t realization, std::size_t receiver, std::size_t part, double E) const {
    const std::size_t k = whole_of(part);
    for (const TimeIntegral& integral : integrals_)
      (*integral.exposure)[realization][receiver] += E * integral.seconds[k];
    if (of_realizations_)
      (*of_realizations_)[realization][receiver * block_width + k] += static_cast<float>(E);
  }
  void add_pooled(std::size_t receiver, std::size_t k, double E) const {
    pooled_[receiver * block_width + whole_of(k)] += static_cast<float>(E);
  }
  /// Adds what all realizations have alike, and the pooled one, by all suns of the block.
  void add_alike(std::size_t receiver, const std::array<double, block_width>& of_suns) const {
    if (whole_ == every_one) return add_columns_alike(receiver, of_suns);
    std::array<double, block_width> E{};
    for (const double of_part : of_suns) E[whole_] += of_part;
    add_columns_alike(receiver, E);
  }
  /// Adds `E(r)` of all realizations, and their mean to the pooled one.
  template <class Irradiance>
  void add_all(std::size_t receiver, std::size_t k, const Irradiance& E) const {
    double mean = 0;
    for (std::size_t r = 0; r < realizations_; ++r) {
      const double of_realization = E(r);
      mean += of_realization / static_cast<double>(realizations_);
      add(r, receiver, k, of_realization);
    }
    add_pooled(receiver, k, mean);
  }

 private:
  void add_columns_alike(std::size_t receiver, const std::array<double, block_width>& E) const {
    const std::size_t begin = receiver * block_width;
    for (std::size_t k = 0; k < block_width; ++k) pooled_[begin + k] += static_cast<float>(E[k]);
    if (of_realizations_)
      for (Columns& columns : *of_realizations_)
        for (std::size_t k = 0; k < block_width; ++k)
          columns[begin + k] += static_cast<float>(E[k]);
    for (const TimeIntegral& integral : integrals_) {
      double sum = 0;
      for (std::size_t k = 0; k < block_width; ++k) sum += E[k] * integral.seconds[k];
      if (sum <= 0) continue;
      for (std::vector<double>& of_realization : *integral.exposure)
        of_realization[receiver] += sum;
    }
  }

  Columns& pooled_;
  std::size_t realizations_;
  std::vector<TimeIntegral> integrals_;
  std::vector<Columns>* of_realizations_;
  static constexpr std::size_t every_one = block_width;
  std::size_t whole_ = every_one;
};

/// All that rays bring to N receivers in one block of suns.
struct RayLight {
  RayColumns pooled;
  Columns sunlit;  ///< [N][block] share of the receiver that sees the sun
  SunColumns of_realizations;
  std::vector<Columns> by_samples;  ///< [R] all but gloss; if asked for
};

/// Time integrals of the same per realization, [R][N] J m-2, over all blocks of a batch.
struct RaySums {
  RaySums() = default;
  RaySums(std::size_t realizations, std::size_t receivers)
      : direct(realizations, std::vector<double>(receivers, 0)),
        mirror(direct),
        circumsolar(direct) {}
  std::vector<std::vector<double>> direct, mirror, circumsolar;
  /// By gloss onto patches, which comes by lines; else empty. On sensors it is part of `mirror`.
  std::vector<std::vector<double>> gloss;
};

}  // namespace sunload
