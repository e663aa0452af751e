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
/// For functions that fill such columns only if they are asked for.
inline std::vector<Columns>* or_none(std::vector<Columns>& of_realizations) {
  return of_realizations.empty() ? nullptr : &of_realizations;
}
/// The sum of all columns of each realization.
std::vector<Columns> summed(const SunColumns& columns);

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
