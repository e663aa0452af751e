// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Which clusters of bright surfaces neighbouring patches see, from pairs of points.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/lines/bright_surfaces.h"
#include "solver/surface/ray_caster.h"

namespace sunload {

class ClusterSight {
 public:
  /// Nothing is known.
  ClusterSight() = default;
  /// Casts about `rays` rays, fewer where much faces away. Cost: as many shadow rays.
  ClusterSight(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
               const BrightSurfaces& surfaces, double rays, std::uint64_t seed);

  /// Mean of cosθ_x cosθ_y over pairs of points, one of a group of patches and one of a cluster.
  /// seen: pairs that do not see each other count 0; around: the sum of `seen` over these and the
  /// groups and clusters around that face alike; facing: as if nothing was in between.
  struct Share {
    float seen, around, facing;
  };
  /// One for every cluster; null where nothing is known.
  const Share* row(std::size_t patch) const {
    return shares_.empty() ? nullptr : &shares_[group_of_patch_[patch] * clusters_];
  }

 private:
  struct View;
  void group_patches(const View& view, const Scene& scene, double rays);
  bool may_face(const View& view, std::size_t group, std::size_t cluster) const;
  void see(const View& view, std::size_t group, std::size_t cluster, Share& share) const;
  void look_around(const View& view);

  std::size_t clusters_ = 0;
  int pairs_ = 0;                                   ///< per group and cluster
  std::vector<std::vector<std::uint32_t>> groups_;  ///< patches
  std::vector<std::uint32_t> group_of_patch_;
  std::vector<Share> shares_;  ///< [group][cluster]
};

}  // namespace sunload
