// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Which triangles are of bodies without a hole.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/sight/occluders.h"

namespace sunload {

/// And which way the fronts of a closed body look.
enum class Closed : std::int8_t { inward = -1, no = 0, outward = 1 };

/// Of each triangle, how the body is turned that it is part of, or that it has a hole. A body is
/// what hangs together by edges; it has no hole where all of it is opaque and every edge is passed
/// as often in either direction.
std::vector<Closed> closed_bodies(const Occluders& occluders);

}  // namespace sunload
