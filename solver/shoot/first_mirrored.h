// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Light of sun, sky and far ground that meets mirrors first, sent forward.
///
/// The samples that say what a mirror patch receives (its direct samples that
/// see the sun, its lines that leave the scene) carry that light on by the law
/// of reflection, each its equal share: what mirrors receive first and what
/// they send on balance sample by sample.
#pragma once

#include <span>
#include <vector>

#include "geo/sky/sky.h"
#include "solver/first_light/direct_sun.h"
#include "solver/lines/lines.h"
#include "solver/shoot/deposits.h"
#include "solver/shoot/light_chain.h"

namespace sunload {

class FirstMirrored {
 public:
  /// Follows the lines that mirror patches send to sky and far ground; the same
  /// ones that `trace_lines` casts by these rules.
  FirstMirrored(const Scene& scene, const Hierarchy& hierarchy, const RayCaster& caster,
                const SunSampler& sampler, const SkyGrid& grid, const LineRules& rules);

  bool any() const { return !mirrors_.empty(); }
  std::uint64_t rays() const { return rays_; }  ///< cast by the constructor

  /// Power of the sun that one realization sends on from mirrors.
  struct SentSun {
    Deposits deposits;  ///< [W], the source is the number of the sun in the block
    SunFates fates;
  };
  /// The same of all realizations, and the rays that were cast for them.
  struct SentSuns {
    std::vector<SentSun> of_realization;  ///< empty without mirrors
    std::uint64_t rays = 0;
  };
  SentSuns send(std::span<const IntervalLight> block) const;

  /// Irradiance of a block by way of mirrors [N][block] W m-2, and where the rest ended.
  struct Light {
    DoubleColumns irradiance;
    SunFates fates;
  };
  Light sun(const SentSun& sent) const;
  /// Of the sky in one realization; `sky` is π·radiance, [cells][block].
  Light sky(std::size_t realization, const DoubleColumns& sky) const;
  /// Of the far ground of that exitance.
  Light ground(std::size_t realization, const DoubleColumns& exitance) const;

 private:
  class LineTask;
  class SunTask;
  /// Deposits and fates [m2] of sources that are given by their exitance.
  struct OfSource {
    Deposits deposits;
    std::vector<Fate<double>> fates;  ///< per row of the source
  };
  struct OfRealization {
    OfSource sky, ground;
  };
  Light light_of(const OfSource& source, const DoubleColumns& exitance) const;

  const Hierarchy& hierarchy_;
  const RayCaster& caster_;
  const SunSampler& sampler_;
  const SkyGrid& grid_;
  LightChain chain_;
  LineRules rules_;
  std::vector<std::size_t> mirrors_;  ///< patches that are mirrors
  std::vector<OfRealization> of_realization_;
  std::uint64_t rays_ = 0;
};

}  // namespace sunload
