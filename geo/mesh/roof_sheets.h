// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Roofs that are sheets of their own: planes that reach out over the walls on which they lie, or
/// lie between parapets.
#pragma once

#include <cstdint>
#include <vector>

#include "geo/mesh/orient.h"

namespace sunload {

/// One flag per body, 1 for open ones that look up, have hardly any walls of their own, and lie on
/// those of other bodies: along upper edges of walls, or with their own open edges on walls that go
/// on above and below and look away from them, which all together are a quarter as long in plan as
/// the sheet's open edges, or longer. (Terrain has walls standing on it, which look at it, a canopy
/// stands on posts, a retaining wall is short beside the land that it holds.) Most of them is open
/// to the sky, unlike slabs between storeys. Cost: a look at what is about each upper edge of a
/// wall and each open edge of a sheet.
std::vector<std::uint8_t> roof_sheets(const Mesh& mesh, const Bodies& bodies);

}  // namespace sunload
