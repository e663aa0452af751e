// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The share of every patch that sees the sun, for thousands of suns in one part of the sky, by
/// interpolation between suns of a grid.
///
/// The suns of a year of minutes fill a band of the sky, and from one of them to the next shares
/// change little. So shares are exact (solver/sight/lit_shares.h) for suns at the points of a grid
/// of three quarters of a degree, those that lie about the suns asked for. In between they are
/// bilinear: a shadow is blended from four places of which each is right. The grid is square in
/// Lambert's azimuthal equal-area projection about the zenith (Snyder 1987, Map projections, p.
/// 182). Points below the horizon stand for suns a little above it.
///
/// Where the sun shines upon a patch but some of the four do not, the others tell its share; where
/// none of them shines upon it, or rays must tell of one of them, rays must tell.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <mutex>
#include <span>
#include <vector>

#include "solver/light/sun_block.h"
#include "solver/sight/lit_shares.h"

namespace sunload {

/// A direction in that projection; on a unit sphere areas stay as they are. Not straight down.
struct EqualAreaPlace {
  double x, y;
};
/// `direction`: unit, z up; the zenith lies at (0, 0), the horizon on a circle of radius √2.
EqualAreaPlace equal_area_place(Vec3 direction);

/// A cache of shares at grid points, which answers by interpolation.
class ShareGrid {
 public:
  /// `shares` must outlive it.
  explicit ShareGrid(const LitShares& shares) : shares_(shares) {}

  /// The same as LitShares::of with SendsOn::as_others, but interpolated, in steps of 1/250. Suns
  /// have no disk. Any number of threads may ask; grid points that were asked for last are kept, in
  /// a gigabyte at most, or as many as one call needs. Cost: some nanoseconds for each patch and
  /// sun, and that of LitShares::of for new points.
  Columns of(std::span<const IntervalLight> block) const;
  /// Looks at all points that `of` needs for these, any number: cheaper than block by block.
  void prepare(std::span<const IntervalLight> suns) const;

  /// How many points `of` needs for these suns.
  static std::size_t points_about(std::span<const Vec3> suns);

 private:
  using Codes = std::vector<std::uint8_t>;
  struct Point {
    Codes codes;  ///< [N]
    std::uint64_t asked = 0;
  };
  void tell_points_about(std::span<const IntervalLight> suns) const;
  void tell_points(const std::vector<std::uint32_t>& numbers) const;
  void forget_old(std::size_t to_come) const;
  Columns interpolated(std::span<const IntervalLight> block) const;

  const LitShares& shares_;
  mutable std::mutex mutex_;
  mutable std::map<std::uint32_t, Point> points_;  ///< a cache: what it holds changes no number
  mutable std::uint64_t question_ = 0;
};

}  // namespace sunload
