// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The sun that every patch sees in mirrors, reflected once: exactly, by geometry, without rays.
///
/// Seen along the sun's image, the parts of mirrors that the sun lights
/// (solver/sight/lit_mirrors.h) are windows through which its light falls on what lies before them;
/// faces between cover some of it. Heckbert & Hanrahan (1984), Beam tracing polygonal objects.
///
/// Rays must tell of what is before or behind screens, through which a share of the light passes;
/// and where mirrors or shades make too many parts. Which patches these are does not depend on any
/// random number.
#pragma once

#include <span>
#include <vector>

#include "solver/sight/lit_area.h"
#include "solver/sight/lit_mirrors.h"
#include "solver/sight/lit_shares.h"

namespace sunload {

/// Const, and may be asked from any thread.
class MirroredShares {
 public:
  /// All arguments must outlive it.
  MirroredShares(const LitShares& shares, const MirrorGroups& groups);

  static constexpr float by_rays = LitShares::by_rays;
  /// Of each patch and sun of a block, [N][block_width]: Σ rho_s cosθ · lit area / area over the
  /// mirrors in which it sees the sun, irradiance per DNI; or `by_rays`. `by_mirrors`: of each sun
  /// of the block, points all of them. Cost: some microseconds for each mirror that sees the sun,
  /// and for each patch that it lights.
  Columns of(std::span<const IntervalLight> block,
             std::span<const std::vector<MirroredSun>> by_mirrors) const;

  const LitShares& shares() const { return shares_; }

 private:
  class GroupWork;
  void find_neighbours();

  const LitShares& shares_;
  const MirrorGroups& groups_;
  MirrorPlanes planes_;
  FaceTree tree_;
  /// All of the groups that follow each other within `radius_m` about `centre`.
  struct Neighbours {
    std::size_t begin, end;
    Vec3 centre;
    double radius_m;
  };
  std::vector<Neighbours> neighbours_;
};

}  // namespace sunload
