// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// How far out a scene may lie.
#pragma once

namespace sunload {

/// Of anything that a study or a file places, along each axis. Projected coordinates with a zone
/// prefix reach 6e7 m (Gauss–Krüger, zones up to 60); of millimetres that are taken for metres
/// northings are beyond. A double resolves 0.1 µm there, and the square of a float, in which rays
/// and pictures are computed, overflows at 1e19.
inline constexpr double largest_coordinate_m = 1e9;

}  // namespace sunload
