// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Patches that the sun reaches wholly or not at all, told without rays.
///
/// The shaft of an element is what its points sweep towards the sun. Where no triangle reaches into
/// it, every sample sees the sun. Where a sheet of opaque triangles, joined across edges on either
/// side of which one of them lies as the sun sees it, has none of its other edges in the shaft, it
/// covers all of the shaft or nothing: no sample sees the sun. Elements of which neither is sure
/// are halved, down to patches, which are left to rays. Every test errs towards rays, by more than
/// the ray caster's rounding: what is told here is what all rays would tell, bit for bit. Haines &
/// Wallace (1991), Shaft culling for efficient ray-traced radiosity; the sheets are those of which
/// Teller & Hanrahan (1993), Global visibility algorithms for illumination computations, ask a
/// single silhouette edge.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "solver/light/sun_block.h"
#include "solver/mesh/hierarchy.h"
#include "solver/sight/sun_sight.h"
#include "solver/surface/material.h"
#include "solver/surface/occluders.h"

namespace sunload {

class SunShafts {
 public:
  /// `offset_m`: of the ray caster. `hierarchy` must outlive it. Builds nothing where patches are
  /// as large as the scene's triangles, so that each would be asked for alone.
  SunShafts(const Scene& scene, const Hierarchy& hierarchy, double offset_m);

  /// [N][block_width], of each patch and sun of a block; unknown for those that are down or behind.
  /// A function of the patch and the sun alone.
  std::vector<SunSight> sights(std::span<const IntervalLight> block) const;

  using Element = std::uint32_t;
  using Corners = std::array<std::int32_t, 3>;
  const Corners& corners(Element element) const { return corners_[element]; }
  std::uint32_t patches_in(Element element) const { return patches_in_[element]; }
  const Hierarchy& hierarchy() const { return hierarchy_; }
  const Occluders& occluders() const { return *occluders_; }
  double offset_m() const { return offset_m_; }

 private:
  void measure_elements();
  void choose_groups(Element element);

  const Hierarchy& hierarchy_;
  double offset_m_;
  std::optional<Occluders> occluders_;
  std::vector<Corners> corners_;           ///< per element, vertices of the hierarchy
  std::vector<std::uint32_t> patches_in_;  ///< per element
  std::vector<Element> groups_;            ///< whose occluders are looked for together
};

}  // namespace sunload
