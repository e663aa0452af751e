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

/// Values of the first and the last colour.
struct StyleRange {
  double least = 0, largest = 1;
};

/// QML (QGIS style, version 3.22): graduated colours of a column of numbers in ten classes of equal
/// width; what is beyond has the first or the last.
std::string qgis_style(const std::string& column, StyleRange range, Palette palette, StyledAs as);

}  // namespace sunload
