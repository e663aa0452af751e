// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Some groups of patches (LitShares::Group) side by side, for one look at all of them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "solver/sight/flat_polygon.h"
#include "solver/sight/lit_shares.h"

namespace sunload {

class GroupLanes {
 public:
  static constexpr std::size_t most = 8;
  using Lanes = std::array<double, most>;

  /// Up to `most` groups of these.
  GroupLanes(const LitShares& shares, std::span<const LitShares::Group> groups);

  /// Corners of a group's triangle where patches of it look from.
  std::array<Vec3, 3> corners(std::size_t group) const;

  /// How they look across light.
  struct Seen {
    Lanes x0, x1, y0, y1;  ///< their boxes [m]
    Lanes cos_theta;       ///< 0 where there is no group
  };
  void see(const ViewFrame& frame, Seen& seen) const;
  /// Bit by bit those that face the light by more than `least_cosine`, meet a box across it, and
  /// have some part before a plane.
  std::uint32_t meeting(const Seen& seen, const ViewBox& box, const HalfSpace& before,
                        double least_cosine) const;

 private:
  struct Places {
    Lanes x{}, y{}, z{};
  };
  alignas(64) std::array<Places, 3> corner_;
  Places normal_;
};

}  // namespace sunload
