// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Which triangles are of bodies without a hole.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/sight/occluders.h"

namespace sunload {

/// Whether a triangle is of a body without a hole, and which way the fronts of that body look.
enum class Closed : std::int8_t { inward = -1, no = 0, outward = 1 };

/// Of each triangle.
struct ClosedBodies {
  std::vector<Closed> turned;       ///< `no` where its body has a hole
  std::vector<std::uint32_t> body;  ///< one triangle that stands for all of its body
};

/// A body is what hangs together by edges; it has no hole where all of it is opaque and every edge
/// is passed as often in either direction.
ClosedBodies closed_bodies(const Occluders& occluders);

}  // namespace sunload
