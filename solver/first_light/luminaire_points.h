// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Light of luminaires, which are points.
///
///     E_i = Σ_luminaires 1 / A_i ∫ I(ω) cosθ V / r² dA = Σ 1 / A_i ∫ I(ω) V dω
///
/// over the solid angle Ω_i that the patch has as the luminaire sees it. Samples are directions
/// uniform in it, E_i = Ω_i / A_i · mean of I V: without noise where I is even and nothing stands
/// before the patch, however near the luminaire hangs. Of small solid angles, whose directions lose
/// digits, they are points uniform on the patch, E_i = mean of I cosθ V / r². Shirley, Wang &
/// Zimmerman (1996), Monte Carlo techniques for direct lighting calculations. Where the edge of a
/// beam or of a bright lobe crosses the patch, they are directions of the density p that the
/// photometry asks for, E_i = 1 / A_i · mean of I V / p (solver/surface/luminaire_view.h).
#pragma once

#include <vector>

#include "solver/first_light/lamp_rays.h"
#include "solver/surface/luminaire_view.h"

namespace sunload {

class LuminairePoints {
 public:
  /// `luminaires` must outlive it.
  explicit LuminairePoints(const Luminaires& luminaires);
  void shine_on(std::size_t receiver, LampRays& rays) const;

 private:
  class Receiver;
  const Luminaires& luminaires_;
  std::vector<IntensitySteps> steps_;  ///< per web
};

}  // namespace sunload
