// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Styles that QGIS finds in the table layer_styles of a GeoPackage.
#pragma once

#include <string>

#include "io/base/colour_map.h"

namespace sunload {

/// How a layer is drawn: areas are filled; upright ones are lines from above, so that their outline
/// has the colour; points are dots.
enum class StyledAs { areas, outlines, dots };

/// QML (QGIS style, version 3.22): graduated colours of a column of numbers from 0 to `largest` in
/// ten classes of equal width; what is above has the last.
std::string qgis_style(const std::string& column, double largest, Palette palette, StyledAs as);

}  // namespace sunload
