// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Backs of two-sided surfaces that no light reaches: those of houses, as programs for modelling
/// write them (glTF `doubleSided`, VRML `solid FALSE`).
#pragma once

#include <cstdint>
#include <vector>

#include "geo/mesh/mesh.h"
#include "geo/mesh/orient.h"

namespace sunload {

/// One flag per triangle: 1 where it has two sides and its back is inside of a body, turned outward
/// and opaque all over, that is closed, or closed but for edges at land or below it (a house
/// without a floor). `is_opaque`: per triangle. Lamps would light what is inside: not to be asked
/// where there are some.
std::vector<std::uint8_t> dark_backs(const Mesh& mesh, const Bodies& bodies,
                                     const std::vector<std::uint8_t>& is_opaque);

}  // namespace sunload
