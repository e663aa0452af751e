// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Triangles that lie on others, or under them.
#pragma once

#include <cstdint>
#include <vector>

#include "geo/mesh/mesh.h"

namespace sunload {

/// One flag per triangle: of those in `some` (flags as well) it is 1 where one in `others` is in
/// front of or behind its middle, no farther than floors may be from what they stand on
/// (geo/mesh/surface_kind.h), and in nearly the same plane.
std::vector<std::uint8_t> lying_on(const Mesh& mesh, const std::vector<std::uint8_t>& some,
                                   const std::vector<std::uint8_t>& others);

}  // namespace sunload
