// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// One sample of light on its way forward, along its chain of mirrors, panes, metals and glossy
/// surfaces. Fates are shares of what the source sent; `absorbed` is by any front.
#pragma once

#include <vector>

#include "solver/base/rng.h"
#include "solver/lines/surface_walk.h"
#include "solver/shoot/deposits.h"

namespace sunload {

class LightChain {
 public:
  /// `largest_link`: of elements that receive as a whole (solver/mesh/linked_element.h).
  LightChain(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
             int mirror_depth, double largest_link);

  /// A sample that left row `source` diffusely with `weight` of its power along
  /// the unit vector `w` and met `hit`: deposits on elements of every surface of its chain.
  /// `key` addresses the random numbers of glossy surfaces, from its block on.
  Followed follow(Vec3 w, const Hit& hit, std::uint32_t source, double weight, RandomKey key,
                  std::vector<Deposit>& deposits) const;

  /// A sample of first light that meets a mirror patch at `point` (lifted off
  /// it) from the direction `towards`: absorbed there in part, then sent on to patches.
  Followed mirror_on(Vec3 point, Vec3 towards, std::size_t mirror_patch, std::uint32_t source,
                     double weight, RandomKey key, std::vector<Deposit>& deposits) const;

 private:
  Followed go_on(Vec3 w, Hit hit, std::uint32_t source, double weight, int reflections,
                 RandomKey key, double largest_link, std::vector<Deposit>& deposits) const;

  SurfaceWalk walk_;
  const Hierarchy& hierarchy_;
  double largest_link_;
};

}  // namespace sunload
