// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of the sky where the suns of a period stand, in cells of some two degrees.
///
/// Sectors of azimuth are equal in a pseudo-angle that needs no trigonometry (1/128 of the round,
/// 1.8° … 3.6°), bins of elevation in tan/(1 + tan) (0.9° at the horizon, 1.8° at 45°).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geo/base/vec.h"

namespace sunload {

class SunCells {
 public:
  static constexpr std::size_t sectors = 128, bins = 64;
  using Bins = std::uint64_t;  ///< bit b: bin b
  using Sky = std::array<Bins, sectors>;

  struct Sector {
    Vec3 first, middle;      ///< directions of its first side and of its middle: level, unit
    Vec3 left;               ///< level, unit, across the middle towards its second side
    double tangent, cosine;  ///< of half its width
  };

  /// Cells that hold the disks of these suns (unit vectors; those below the horizon count for
  /// nothing).
  explicit SunCells(std::span<const Vec3> suns);

  const Sky& wanted() const { return wanted_; }
  std::size_t count() const { return count_; }
  const Sector& sector(std::size_t s) const { return sector_[s]; }

  static std::size_t sector_of(double x, double y) {
    const double turn = y / (std::abs(x) + std::abs(y));
    const double angle = x < 0 ? 2 - turn : (y < 0 ? 4 + turn : turn);
    return std::min(sectors - 1, static_cast<std::size_t>(angle * (sectors / 4.0)));
  }
  /// Of a tangent ≥ 0, infinity included.
  static std::size_t bin_of(double tangent) {
    return std::min(bins - 1, static_cast<std::size_t>(place_of(tangent)));
  }
  /// Where in its bin, too.
  static double place_of(double tangent) {
    return tangent < 1e300 ? bins * (tangent / (1 + tangent)) : bins;
  }
  /// Bins first … last.
  static Bins bits(std::size_t first, std::size_t last) {
    const Bins from_first = ~Bins{0} << first;
    return last + 1 < bins ? from_first & ~(~Bins{0} << (last + 1)) : from_first;
  }

  struct Cell {
    std::size_t sector, bin;
  };
  /// Those that a disk of such a half-angle reaches into; none where the sun is too low or too high
  /// to be sure.
  static std::vector<Cell> reached_by(Vec3 sun, double half_angle);

  /// The cell's number among the wanted, or -1.
  std::int32_t number_of(Cell cell) const {
    const Bins bit = Bins{1} << cell.bin;
    if ((wanted_[cell.sector] & bit) == 0) return -1;
    return first_[cell.sector] + std::popcount(wanted_[cell.sector] & (bit - 1));
  }

 private:
  Sky wanted_{};
  std::array<std::int32_t, sectors> first_{};
  std::array<Sector, sectors> sector_;
  std::size_t count_ = 0;
};

}  // namespace sunload
