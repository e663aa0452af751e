// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Whether a vertical line meets a triangle, exactly.
#pragma once

#include <array>

#include "geo/base/vec.h"

namespace sunload {

/// Whether a vertical line through (x, y), moved aside by nothing, meets the triangle: +1 where it
/// looks up, -1 down, 0 not. Of triangles at an edge or corner below the line just one side is met
/// (Edelsbrunner, Mücke 1990, Simulation of simplicity).
int plumb_crossing(const std::array<Vec3, 3>& corners, double x, double y);

}  // namespace sunload
