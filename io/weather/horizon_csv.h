// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Horizon files.
#pragma once

#include <string>

#include "geo/sky/horizon.h"

namespace sunload {

/// Reads a text table of a horizon line [degrees]. Two kinds, told apart by their header:
///
/// - columns `azimuth_deg`, clockwise from true north, and `elevation_deg`, in any order and
///   among others;
/// - as PVGIS prints it: columns `A`, 0 in the south, positive towards west, -180 … 180, and
///   `H_hor`; lines before the header and after the first empty line below it are not read.
///
/// Fields are divided by commas, semicolons, tabs or blanks; # begins a comment. At least two
/// rows. Throws InputError with file:line for anything else.
Horizon read_horizon_csv(const std::string& path);

}  // namespace sunload
