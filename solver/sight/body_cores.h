// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Convex solids within closed bodies. What has such a core between itself and the sun is dark: a
/// way out of a closed body crosses its surface, whatever faces that is made of. A house of
/// thousands of faces, of which each shades a little, has few cores.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/sight/closed_bodies.h"
#include "solver/sight/convex_faces.h"
#include "solver/sight/occluders.h"

namespace sunload {

struct BodyCore {
  static constexpr std::size_t most_corners = 16;
  std::vector<Vec3> corners;
  std::vector<std::array<std::uint8_t, 2>> edges;  ///< numbers of corners
};

/// `faces`: all of the bodies. Cores are grown about points inside until faces stop them, after the
/// manner of Deits & Tedrake (2015), Computing large convex regions of obstacle-free space through
/// semidefinite programming: here by planes of faces alone, those that leave the largest volume,
/// the largest faces first. They keep `away_m` from faces. That a point is inside tells the winding
/// number (Jacobson, Kavan & Sorkine-Hornung 2013, Robust inside-outside segmentation using
/// generalized winding numbers), so that bodies may cross themselves. A core that stands for fewer
/// than `faces_per_core` costs as much as it saves. Cost: some milliseconds for a house of
/// hundreds.
std::vector<BodyCore> body_cores(const Occluders& occluders, const ClosedBodies& bodies,
                                 const std::vector<ConvexFace>& faces, double away_m,
                                 std::size_t faces_per_core = 8);

}  // namespace sunload
