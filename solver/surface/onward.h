// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What a surface sends on of light that arrives from one direction: by the law of reflection, as a
/// mirror, a pane or a metal, or in one direction of its lobe.
#pragma once

#include "solver/base/rng.h"
#include "solver/surface/material.h"

namespace sunload {

/// Shares are those of what arrived.
struct Onward {
  Vec3 direction;
  double weight = 0;                     ///< carried along `direction`
  double transmitted = 0, absorbed = 0;  ///< of materials that depend on the angle
};
/// Of light that arrives along -`w` (unit, w·n > 0) at a surface of normal `n`. `key` addresses
/// the random numbers of glossy surfaces.
Onward onward(const Material& material, Vec3 n, Vec3 w, const RandomKey& key);

/// Share of the light on a surface that it absorbs, where `on` says what it sends on.
inline double absorbed_share(const Material& m, const Onward& on) {
  return depends_on_angle(m) ? on.absorbed : left_over(1 - m.diffuse - m.mirror - m.transmittance);
}

}  // namespace sunload
