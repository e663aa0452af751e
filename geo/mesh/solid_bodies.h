// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Bodies that have an inside which no light reaches.
#pragma once

#include <cstdint>
#include <vector>

#include "geo/mesh/mesh.h"
#include "geo/mesh/orient.h"

namespace sunload {

/// One flag per body, 1 for those of opaque triangles alone that are closed and no rooms, or that
/// are open below alone (geo/mesh/open_below) and stand on what closes them there: along all of the
/// open edges the mesh's land, no more than 5 `contact` lower, or other solids in which, or on
/// which, they stand (dormers, chimneys). What lies below such a foot is dark as well.
std::vector<std::uint8_t> solid_bodies(const Mesh& mesh, const Bodies& bodies,
                                       const std::vector<std::uint8_t>& is_opaque, double contact);

}  // namespace sunload
