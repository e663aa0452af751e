// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The share of every patch that sees the sun: exactly, by geometry, without rays.
///
/// Seen from the sun, the faces that stand before a patch cover it by polygons; the share of its
/// area that none of them covers is lit (solver/sight/lit_area.h). Patches of one face are looked
/// at in groups, and with all suns of a block side by side: most of them are found to be wholly lit
/// or dark by a few edges.
///
/// Rays must tell of patches behind screens, through which a share of the light passes; of a sun
/// with a disk of which a part is hidden; of patches that are shaded by so many faces that rays
/// cost less; and, if these are to, of surfaces that send light on (mirrors, panes, gloss) where a
/// shadow's edge crosses them, so that what they receive and what they send on rest on the same
/// rays. Which patches these are does not depend on any random number.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/light/sun_block.h"
#include "solver/light/transport.h"
#include "solver/mesh/hierarchy.h"
#include "solver/sight/plane_groups.h"
#include "solver/sight/sun_view.h"

namespace sunload {

/// What tells the share of a surface that sends light on where a shadow's edge crosses it. by_rays:
/// the rays that the light it sends on rests on, so that none is lost between the two; as_others:
/// geometry, where no light is sent on by rays, or so little that the difference is none.
enum class SendsOn { by_rays, as_others };
/// What tells it in a scene of whose surfaces such a share, by area, sends light on. No more than a
/// tenth is little: samples of the sun tell where it goes on to. What is shot is told to the last
/// sample.
inline SendsOn asked_for_the_sun(double sending_share, Transport transport) {
  constexpr double little = 0.1;
  return transport == Transport::shoot || sending_share > little ? SendsOn::by_rays
                                                                 : SendsOn::as_others;
}

/// Shares for any block of suns; const, and may be asked from any thread.
class LitShares {
 public:
  /// `offset_m`: of the ray caster. Patches look from so far before them, as rays do; nothing that
  /// is nearer shades them. `hierarchy` must outlive it.
  LitShares(const Scene& scene, const Hierarchy& hierarchy, double offset_m);

  /// Of each patch and sun of a block, [N][block_width], in [0, 1]; `by_rays` where rays must tell,
  /// and for suns that are down or behind. Cost: some 0.1 … 0.3 µs of a processor for each of them.
  Columns of(std::span<const IntervalLight> block, SendsOn what_sends_on = SendsOn::by_rays) const;
  static constexpr float by_rays = -1;

  const PlaneGroups& groups() const { return groups_; }
  const Hierarchy& hierarchy() const { return hierarchy_; }
  const SunFaces& faces() const { return faces_; }
  double offset_m() const { return offset_m_; }

 private:
  const Hierarchy& hierarchy_;
  double offset_m_;
  SunFaces faces_;
  PlaneGroups groups_;
  SunView::Extent extent_;
};

}  // namespace sunload
