// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Direct sun by way of glossy surfaces: next-event estimation at the lines' meetings.
///
/// A glossy lobe has no image direction. But where a line of receiver i (a patch or a sensor)
/// meets a glossy surface (a glimpse, recorded when lines are traced), every sun can be asked: one
/// shadow ray from there along s brings, with f_r the lobe of solver/surface/lobe.h and w the
/// line's weight so far,
///
///     E_i += π / lines · w · f_r(s, -line) · (s·n) · dni · visible
///
/// Exact but for noise, also by way of mirrors between receiver and glossy surface, and of further
/// lobes. Few glimpses lie in narrow lobes, so these are looked for from the receivers instead
/// (solver/first_light/lobe_images.h), but by way of mirrors and further lobes. Sun that a mirror
/// sends to a glossy surface is cut there. Of a sun with a disk each glimpse asks a point of its
/// own; s·n stays that of its centre.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/first_light/lobe_images.h"
#include "solver/first_light/mirror_chains.h"
#include "solver/lines/line_follower.h"
#include "solver/mesh/patch_optics.h"

namespace sunload {

class GlossySun {
 public:
  /// Everything must outlive it.
  GlossySun(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
            const SunSampler& sampler, const PatchOptics& optics, const LineRules& rules);

  /// As MirrorSun::add_light, on the patches whose lines these are, but for what `images`, of the
  /// same receivers, stand for.
  std::uint64_t add_light(const Lines& lines, const LobeImages& images,
                          std::span<const IntervalLight> block, const RaySink& into) const {
    return add_light(lines, images, false, block, into);
  }
  /// The same on sensors.
  std::uint64_t add_light_on_sensors(const Lines& lines, const LobeImages& images,
                                     std::span<const IntervalLight> block,
                                     const RaySink& into) const {
    return add_light(lines, images, true, block, into);
  }

  /// Adds to `fates` ([realizations]) where the direct sun ends that glossy patches receive:
  /// each visible sample goes on in a direction of the lobe.
  void follow_light(std::span<const IntervalLight> block, std::vector<SunFates>& fates) const;

 private:
  class Chunk;
  std::uint64_t add_light(const Lines& lines, const LobeImages& images, bool are_sensors,
                          std::span<const IntervalLight> block, const RaySink& into) const;
  void send_on(const LineFollower& follower, const IntervalLight& sun, std::size_t k,
               std::size_t patch, std::vector<SunFates>& fates) const;

  const Scene& scene_;
  const Hierarchy& hierarchy_;
  const RayCaster& caster_;
  const SunSampler& sampler_;
  const PatchOptics& optics_;
  LineRules rules_;
};

}  // namespace sunload
