// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Exchange between two plane polygons with nothing between them.
///
///     A_i F_ij = 1/2π ∮_i ∮_j ln r dx·dy
///
/// The inner integral along an edge is elementary; the outer one is done by Gauss–Legendre points,
/// halved until it is as exact as asked for. Sparrow (1963), A new and simpler formulation for
/// radiative angle factors; Cohen & Wallace (1993), Radiosity and realistic image synthesis, 4.8.
#pragma once

#include <span>
#include <vector>

#include "geo/base/vec.h"

namespace sunload {

/// The part of a convex polygon in front of a plane through `at` with the unit normal `n`; empty
/// where none of it is, by more than `tolerance_m`.
std::vector<Vec3> in_front(std::span<const Vec3> polygon, Vec3 at, Vec3 n, double tolerance_m);

/// A_i F_ij [m2] of convex polygons, counter-clockwise from their fronts, each wholly in front of
/// the other's plane and in full view; within 1e-6 of itself, for those that touch, too.
double exchange_area(std::span<const Vec3> from, std::span<const Vec3> to);

}  // namespace sunload
