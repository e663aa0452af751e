// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What a surface mirrors and transmits without scattering it, by its angle: one kind of four.
/// A property of one kind is added here, and whoever reads, writes or hashes the kind does not
/// compile until it has it (docs/developer/how-to-add.md).
#pragma once

#include <variant>

namespace sunload {

/// The same at every angle: diffuse + mirror + glossy + transmittance ≤ 1, the rest is absorbed.
struct ConstantShares {
  bool operator==(const ConstantShares&) const = default;
};
/// By Fresnel's formulas; what they transmit leaves the outdoor scene.
struct Panes {
  double refractive_index = 0;  ///< n > 1
  double thickness_m = 0.004;   ///< of one pane
  double absorption_per_m = 0;  ///< K of the glass
  int count = 1;                ///< equal panes one behind the other
  bool operator==(const Panes&) const = default;
};
/// Panes whose index is not known (solver/surface/clear_glass.h), with constant shares diffuse and
/// mirror; diffuse + mirror + transmitted ≤ 1 at every angle.
struct ClearGlass {
  double normal_transmittance = 0;  ///< T0 > 0
  bool operator==(const ClearGlass&) const = default;
};
/// By Fresnel's formulas with the complex index n + i k.
struct Metal {
  double refractive_index = 0;        ///< n > 0
  double extinction_coefficient = 0;  ///< k > 0
  bool operator==(const Metal&) const = default;
};
using Smooth = std::variant<ConstantShares, Panes, ClearGlass, Metal>;

}  // namespace sunload
