// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What rays bring to one set of receivers, patches or sensors, in a block of suns: E_0 but for
/// what comes by lines.
#pragma once

#include <cstddef>
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

/// Where one kind of rays leaves what it brings to N receivers: pooled, and where they are wanted
/// the time integrals and the columns of every realization.
class RaySink {
 public:
  /// `exposure`: [R][N] J m-2, or null. `of_realizations`: [R] columns, or null or none. All of
  /// them must outlive it, and have room.
  RaySink(Columns& pooled, std::size_t realizations, std::vector<std::vector<double>>* exposure,
          std::vector<Columns>* of_realizations)
      : pooled_(pooled),
        realizations_(realizations),
        exposure_(exposure),
        of_realizations_(of_realizations && !of_realizations->empty() ? of_realizations : nullptr) {
  }

  std::size_t realizations() const { return realizations_; }
  /// Adds irradiance E [W m-2] by sun k of the block, as one realization has it; the pooled one is
  /// for the caller to add.
  void add(std::size_t realization, std::size_t receiver, std::size_t k, double E,
           double length_s) const {
    if (exposure_) (*exposure_)[realization][receiver] += E * length_s;
    if (of_realizations_)
      (*of_realizations_)[realization][receiver * block_width + k] += static_cast<float>(E);
  }
  void add_pooled(std::size_t receiver, std::size_t k, double E) const {
    pooled_[receiver * block_width + k] += static_cast<float>(E);
  }
  /// Adds `E(r)` of all realizations, and their mean to the pooled one.
  template <class Irradiance>
  void add_all(std::size_t receiver, std::size_t k, double length_s, const Irradiance& E) const {
    double mean = 0;
    for (std::size_t r = 0; r < realizations_; ++r) {
      const double of_realization = E(r);
      mean += of_realization / static_cast<double>(realizations_);
      add(r, receiver, k, of_realization, length_s);
    }
    add_pooled(receiver, k, mean);
  }

 private:
  Columns& pooled_;
  std::size_t realizations_;
  std::vector<std::vector<double>>* exposure_;
  std::vector<Columns>* of_realizations_;
};

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
