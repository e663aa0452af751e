// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Suns that are computed side by side, and per-patch columns for them.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geo/base/vec.h"
#include "solver/base/large_filled.h"
#include "solver/base/large_memory.h"

namespace sunload {

/// Width of a block of suns. 16 floats fill one cache line, and the columns of
/// some 60 000 patches stay in the second-level cache (blocks of 32 took three
/// times as long per sun).
inline constexpr std::size_t block_width = 16;

/// Suns of a batch are put into blocks in the order of this [rad]: those that stand close together
/// come side by side.
inline double place_in_batch(Vec3 to_sun) { return std::atan2(to_sun.x, to_sun.y); }

/// One of several suns that stand for an interval.
struct SunSample {
  Vec3 direction;     ///< to it, scene frame, unit
  double dni_share;   ///< of the interval's direct radiant exposure, all together 1
  double time_share;  ///< of its sunlit time, likewise
};

/// Light of one interval, as means over the interval [W m-2]. All numbers are finite, all but
/// directions 0 or more; `expect_valid` says so.
struct IntervalLight {
  std::uint32_t number = 0;  ///< of the interval in the period: address of random numbers
  Vec3 direction{0, 0, 1};   ///< to the sun, scene frame, unit where there is a sun
  /// Suns that stand for the interval, in the order of time, where several do; else empty. The sky
  /// is that of `direction`, or where there are `direct_suns` the mean of theirs.
  std::vector<SunSample> sun_samples;
  /// More of them, for what is straight from the sun alone: where an interval is made of many
  /// shorter ones; else empty.
  std::vector<SunSample> direct_suns;
  double dni = 0;
  double dhi = 0;
  double ground_exitance = 0;  ///< of the far ground, its albedo times GHI
  /// Mean radiance per cell of the sky grid [W m-2 sr-1], of all cells or none; empty: dark.
  std::vector<double> sky;
  double length_s = 0;
  double sunlit_s = 0;         ///< above 0: the sun's centre is above the horizon
  double sun_share = 1;        ///< of the interval's sunlit time, in what `sun_samples` makes
  double disk_half_angle = 0;  ///< of the sun's disk [rad], below π/2; 0: a point

  /// The same light in one band (solver/light/band.h).
  struct Band {
    double dni = 0, ground_exitance = 0;
    std::vector<double> sky;
  };
  std::vector<Band> bands;  ///< red, green, blue; empty where bands are not asked for

  /// Tangent of the half-angle of the disk.
  double disk_spread() const { return disk_half_angle > 0 ? std::tan(disk_half_angle) : 0; }
  bool has_direct_suns() const { return !direct_suns.empty(); }
  bool has_sun() const { return sunlit_s > 0 && direction.z > 0; }
  bool is_dark() const { return !has_sun() && dhi <= 0; }
};

/// Throws std::logic_error for light that is none: a number that is not finite or below 0, a sky
/// (also of a band) of another number of cells than `sky_cells`, a sun above the horizon whose
/// direction is not of unit length. All light that is solved passes here. Cost: one look at each
/// cell.
void expect_valid(std::span<const IntervalLight> suns, std::size_t sky_cells);

/// One value per patch (or sky cell) and sun of a block: rows of `block_width` floats, aligned to
/// cache lines.
using Columns = LargeVector<float>;

inline Columns columns(std::size_t rows) { return large_zeros<float>(rows * block_width); }

/// The same where sums must keep all digits.
using DoubleColumns = LargeVector<double>;

inline DoubleColumns double_columns(std::size_t rows) {
  return large_zeros<double>(rows * block_width);
}

}  // namespace sunload
