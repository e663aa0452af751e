// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What share of every patch sees the sun: exactly, by geometry, without rays.
///
/// As the sun sees the scene, what stands before a patch covers it by polygons; the share of its
/// area that none of them covers is lit (solver/sight/lit_area.h). Patches of one triangle are
/// looked at in groups, and with all suns of a block side by side: most of them are found to be
/// wholly lit or dark by a few edges.
///
/// Left to rays are: what stands behind screens, through which light passes by chance; a sun with a
/// disk of which a part is hidden; patches that are shaded by so many faces that rays cost less;
/// and where a shadow's edge crosses surfaces that send light on as mirrors, panes and gloss do,
/// since what they receive and what they send on rests on the same rays. Which these are does not
/// depend on any random number.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/light/sun_block.h"
#include "solver/mesh/hierarchy.h"
#include "solver/sight/sun_view.h"

namespace sunload {

/// How surfaces that send light on are told where a shadow's edge crosses them: by the rays that
/// what they send on rests on, or as all others, where it does not.
enum class SendsOn { by_rays, as_others };

class LitShares {
 public:
  /// `offset_m`: of the ray caster. As rays do, patches look from so far before them, and nothing
  /// nearer shades them.
  /// `hierarchy` must outlive it.
  LitShares(const Scene& scene, const Hierarchy& hierarchy, double offset_m);

  /// Of each patch and sun of a block, [N][block_width], in [0, 1]; `by_rays` where rays must tell,
  /// and for suns that are down or behind. Cost: some 0.1 … 0.3 µs of a processor for each of them.
  Columns of(std::span<const IntervalLight> block, SendsOn what_sends_on = SendsOn::by_rays) const;
  static constexpr float by_rays = -1;

  /// Patches of one triangle that are looked at together.
  struct Group {
    std::array<std::int32_t, 3> vertices;  ///< of the hierarchy, in either order
    std::size_t first, count;              ///< of its patches in a list
    bool sends_on;                         ///< as a mirror, pane or gloss
    Vec3 normal;
    double plane_offset;  ///< normal · any point of the plane
  };
  std::span<const std::uint32_t> patches_of(const Group& group) const {
    return std::span(patch_).subspan(group.first, group.count);
  }
  const Hierarchy& hierarchy() const { return hierarchy_; }
  const SunFaces& faces() const { return faces_; }
  double offset_m() const { return offset_m_; }

 private:
  void choose_groups(const Scene& scene);

  const Hierarchy& hierarchy_;
  double offset_m_;
  SunFaces faces_;
  SunView::Extent extent_;
  std::vector<std::uint32_t> patch_;  ///< group by group
  std::vector<Group> groups_;
};

}  // namespace sunload
