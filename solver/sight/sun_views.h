// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What all patches see of all suns of a long period, looked up once and kept: two bits for each
/// patch and cell of the sky in which suns stand.
///
/// Where nothing reaches into a cell, from any point of the patch, every sample sees the suns of
/// that cell; where one convex face covers it, none does. Both err towards rays, by more than the
/// ray caster's rounding: what is told here is what all rays would tell, bit for bit. What a patch
/// may see of a region, bounded from outside and from inside: Teller & Hanrahan (1993), Global
/// visibility algorithms for illumination computations; Cohen-Or et al. (2003), A survey of
/// visibility for walkthrough applications.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/light/sun_block.h"
#include "solver/mesh/hierarchy.h"
#include "solver/sight/sun_cells.h"
#include "solver/sight/sun_sight.h"
#include "solver/surface/material.h"

namespace sunload {

class SunViews {
 public:
  /// `suns`: unit directions of the period's suns, in any order. `offset_m`: of the ray caster.
  /// Cost: some 0.3 ms of a processor per patch (street).
  SunViews(const Scene& scene, const Hierarchy& hierarchy, double offset_m,
           std::span<const Vec3> suns);

  /// [N][block_width], of each patch and sun of a block; unknown for suns of other cells, and for
  /// those that are down or behind. A function of the patch and the sun alone.
  std::vector<SunSight> sights(std::span<const IntervalLight> block) const;

 private:
  SunCells cells_;
  std::vector<Vec3> normal_;
  std::size_t words_ = 0;                     ///< of a patch
  std::vector<std::uint64_t> open_, closed_;  ///< [N][words]
};

}  // namespace sunload
