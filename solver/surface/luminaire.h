// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Luminaires: points that send light by direction, as their photometry says.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geo/base/vec.h"
#include "geo/lamp/intensity_web.h"

namespace sunload {

/// One lamp: its place, how it is turned, and which photometry of `Luminaires::webs` it has.
struct Luminaire {
  Vec3 position;  ///< relative to the mesh's origin
  Vec3 axis;      ///< unit: where γ is 0
  Vec3 plane_0;   ///< unit, across the axis: where plane C 0 lies; that of C 90 is plane_90
  Vec3 plane_90;
  std::size_t web = 0;
  double scale = 1;       ///< of the web's intensities
  std::uint64_t key = 0;  ///< stable address of its random numbers

  Luminaire() = default;
  /// `turn_rad`: of plane C 0 from +x, counterclockwise seen from above; tilted with the axis by
  /// the smallest turn from straight down.
  Luminaire(Vec3 position, Vec3 axis, double turn_rad);
};

/// Luminaires and what they have in common.
struct Luminaires {
  std::vector<IntensityWeb> webs;
  std::vector<Luminaire> all;

  bool any() const { return !all.empty(); }
  /// Intensity of a luminaire towards a unit direction [W/sr, or cd].
  double intensity(const Luminaire& luminaire, Vec3 direction) const;
  /// Of all of them [W, or lm].
  double flux() const;
};

}  // namespace sunload
