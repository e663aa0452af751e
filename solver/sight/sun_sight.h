// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What is known of a patch and a sun before any ray is cast.
#pragma once

#include <cstdint>

namespace sunload {

enum class SunSight : std::uint8_t {
  unknown,
  open,   ///< every ray from the patch to the sun would leave the scene
  closed  ///< every one would be stopped
};

// What proofs leave to rays, in offsets of the ray caster, which are more than twice what rounding
// may move a ray's origin by (solver/surface/ray_caster.cpp). Its directions and its tests of edges
// add less than that again.
inline constexpr double lateral_offsets = 2;
/// Below the origins of all rays.
inline constexpr double surely_below_offsets = 0.25;
/// Sine of the angle by which a patch must face the sun: beyond that the rounding of normals may
/// turn it.
inline constexpr double least_facing = 1e-3;

}  // namespace sunload
