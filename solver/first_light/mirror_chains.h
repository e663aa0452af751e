// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// The sun's light from mirror to mirror, followed from where it meets the first.
///
/// Books where it ends, and brings it to the patches that it meets wherever no
/// beam (solver/first_light/sun_beams.h) stands for its sequence of mirrors: without bias, with
/// the noise of samples. So curved glass of many facets is served too. What was
/// reflected twice or more and carries less than a negligible share is cut.
///
/// Where beams stand for all that is not negligible, chains tell of its ends alone. Of few mirrors
/// these are a small share of all light, for which some samples serve as well.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/first_light/mirror_sun.h"
#include "solver/light/fate.h"
#include "solver/lines/surface_walk.h"
#include "solver/mesh/hierarchy.h"

namespace sunload {

/// How far sunlight is followed from mirror to mirror.
struct ChainRules {
  int mirror_depth = 8;   ///< reflections that are followed
  double negligible = 0;  ///< share of the sun below which further reflections are cut
  /// Where chains only tell of ends, they are some samples of a sun over all mirrors. Else they
  /// begin with every sample of every patch: no light is lost between what patches get and send on.
  bool books_samples = false;
};

/// The samples that see the sun on a mirror patch start the chains. All arguments but the rules
/// must outlive it.
class MirrorChains {
 public:
  MirrorChains(const Hierarchy& hierarchy, const RayCaster& caster, const SunSampler& sampler,
               const MirrorGroups& groups, const ChainRules& rules);

  /// Where the sunlight of a block ended after its first mirror, and the work that it took.
  struct SentOn {
    std::vector<SunFates> fates;  ///< per realization, each with its own samples
    std::uint64_t rays = 0;
    std::uint64_t shots = 0;  ///< arrivals that no beam stands for
  };
  /// Follows the direct sun that mirror patches receive; adds to `into` what no
  /// beam brings. `shares`: of patches that see the suns (LitShares::of).
  SentOn follow(std::span<const IntervalLight> block, std::span<const SunBeams> beams,
                const Columns& shares, const RaySink& into) const;
  /// 1 for each triangle of the scene that is a mirror and of which no patch sees sun k, else 0.
  std::vector<std::uint8_t> dark_mirrors(const IntervalLight& sun, std::size_t k,
                                         const Columns& shares) const;

 private:
  class Task;
  /// A patch before the sun.
  struct Mirror {
    std::size_t patch = 0;
    std::size_t group = 0;
    double cos_theta = 0;
    double power = 0;  ///< that it receives if all of it sees the sun [W]
    double reflectance = 0;
    double share = -1;  ///< that sees the sun; below 0: samples tell
  };
  /// Patches by what they receive.
  class PoweredMirrors {
   public:
    void add(const Mirror& mirror);
    std::span<const Mirror> all() const { return mirrors_; }
    double power() const { return end_.empty() ? 0 : end_.back(); }  ///< of all [W]
    /// That by which the sum of the powers exceeds a part of it.
    const Mirror& at(double power) const;

   private:
    std::vector<Mirror> mirrors_;
    std::vector<double> end_;  ///< sum of powers up to and with each
  };
  struct SunOnMirrors {
    std::size_t k;
    PoweredMirrors mirrors;
  };

  Mirror mirror(std::size_t patch, const IntervalLight& sun) const;
  /// Those that may see it.
  PoweredMirrors mirrors_before(const IntervalLight& sun, std::size_t k,
                                const Columns& shares) const;
  /// Of the sun's light on mirrors of which the share is known that sees it [W].
  Fate<double> stays_on(std::span<const Mirror> mirrors) const;
  /// Uniform on the patch, off its surface.
  Vec3 point(const Mirror& mirror, const RandomWords& words) const;
  void gather(std::span<const Task> tasks, const RaySink& into, SentOn& sent) const;
  /// Every sample of every patch, of these suns of the block.
  void follow_each(std::span<const IntervalLight> block, std::span<const SunBeams> beams,
                   const Columns& shares, std::span<const std::size_t> suns, const RaySink& into,
                   SentOn& sent) const;
  /// Of suns whose beams bring all: as many samples as the ledger needs.
  void follow_some(std::span<const IntervalLight> block, std::span<const SunBeams> beams,
                   std::span<const SunOnMirrors> suns, const RaySink& into, SentOn& sent) const;
  const Hierarchy& hierarchy_;
  const RayCaster& caster_;
  const SunSampler& sampler_;
  const MirrorGroups& groups_;
  ChainRules rules_;
  SurfaceWalk walk_;
  std::vector<std::size_t> mirrors_;  ///< patches
};

}  // namespace sunload
