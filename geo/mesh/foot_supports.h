// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Bodies that stand on other bodies.
#pragma once

#include <vector>

#include "geo/mesh/feet.h"

namespace sunload {

/// Gives `Stance::body` to feet that have another body below most of their edges, and to those that
/// rest on a lower one with less of them (a slab on a core, a house that juts out over its
/// neighbour, a roof on columns) where land would have to climb to the rest: where the model has
/// land, by that; else by the bodies within `foot_reach_m`, but for those that carry it or rest on
/// the same body, of which more area stands nearer to the level of what carries it than to its own.
/// Where these are no help it rests where it would not fall and what carries it looks like no
/// cellar.
///
/// A body rests on another whose roof touches a tenth of its edges, half a metre behind its walls
/// (outlines overlap by less), or lies wholly below its floor. Feet must have their floors.
void find_supports(const Mesh& mesh, const Bodies& bodies, std::vector<Foot>& feet);

}  // namespace sunload
