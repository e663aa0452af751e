// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// One sample of light on its way forward, along its chain of mirrors, panes, metals and
/// glossy surfaces.
#pragma once

#include <vector>

#include "solver/base/rng.h"
#include "solver/mesh/hierarchy.h"
#include "solver/shoot/deposits.h"
#include "solver/surface/ray_caster.h"

namespace sunload {

/// Where the power of samples ends that is not reflected diffusely; shares of
/// what their source sent.
struct Fate {
  double absorbed = 0;     ///< by fronts
  double backs = 0;        ///< met the back of a one-sided surface
  double escaped = 0;      ///< left the scene
  double cut = 0;          ///< would go on beyond the mirror depth
  double transmitted = 0;  ///< through panes, out of the scene
  std::uint64_t rays = 0;
  Fate& operator+=(const Fate& other);
};

/// The same for every sun of a block [W].
struct Fates {
  double absorbed[block_width] = {}, backs[block_width] = {}, escaped[block_width] = {},
         cut[block_width] = {}, transmitted[block_width] = {};
  /// Adds the fate of what a source of these powers sent.
  void add(const Fate& fate, const double* power);
  Fates& operator+=(const Fates& other);
};

class LightChain {
 public:
  /// `largest_link`: of elements that receive as a whole (solver/mesh/linked_element.h).
  LightChain(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
             int mirror_depth, double largest_link);

  /// A sample that left row `source` diffusely with `weight` of its power along
  /// the unit vector `w` and met `hit`: deposits on elements of every surface of its chain.
  /// `key` addresses the random numbers of glossy surfaces, from its block on.
  Fate follow(Vec3 w, const Hit& hit, std::uint32_t source, double weight, RandomKey key,
              std::vector<Deposit>& deposits) const;

  /// A sample of first light that meets a mirror patch at `point` (lifted off
  /// it) from the direction `towards`: absorbed there in part, then sent on to patches.
  Fate mirror_on(Vec3 point, Vec3 towards, std::size_t mirror_patch, std::uint32_t source,
                 double weight, RandomKey key, std::vector<Deposit>& deposits) const;

 private:
  Fate go_on(Vec3 w, Hit hit, std::uint32_t source, double weight, int reflections, RandomKey key,
             double largest_link, std::vector<Deposit>& deposits) const;
  const Material& material_of(std::int32_t triangle) const;
  Vec3 lifted_point(const Hit& hit, Vec3 normal) const;

  const Scene& scene_;
  const Hierarchy& hierarchy_;
  const RayCaster& caster_;
  int mirror_depth_;
  double largest_link_;
};

}  // namespace sunload
