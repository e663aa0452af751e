// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Land below buildings, of which many terrain models have no data.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "io/scene/raster/raster.h"

namespace sunload {

/// Fills cells without data of which `is_wanted`, where most of the eight directions about them
/// lead to data: its mean there, weighed by the inverse of the distance as GDAL's `fillnodata`
/// does; of lines alone that lead to data both ways, where there are any: these go on with planes
/// as they are. Returns the cells that are filled.
/// Cost: eight times over the raster, where there are any.
std::vector<std::size_t> fill_holes(Raster& raster,
                                    const std::function<bool(std::size_t cell)>& is_wanted);

}  // namespace sunload
