// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What stands around a picture of a scene: title, legend and north arrow.
#pragma once

#include <string>
#include <vector>

#include "geo/base/units.h"
#include "io/base/colour_map.h"
#include "io/picture/colour_scale.h"
#include "io/picture/picture.h"

namespace sunload {

/// Rectangle of pixels.
struct PictureArea {
  int x = 0, y = 0, width = 0, height = 0;
};

/// The part of a picture that the scene fills: below the title, left of the legend.
PictureArea scene_area(const Picture& picture);

void draw_title(Picture& picture, const std::string& title, const std::string& subtitle);

/// The bar of colours beside the scene.
struct Legend {
  std::string units;
  double largest = 1;  ///< value of the last colour
  Palette palette = Palette::false_colour;
  enum class Above { nothing, marked } above = Above::nothing;  ///< larger values occur
  double least = 0;              ///< value of the first colour: 0, −largest, or of decades
  Above below = Above::nothing;  ///< smaller values occur
  ColourScale scale = ColourScale::linear;
};
void draw_legend(Picture& picture, const Legend& legend);
/// A value beside the bar with so many digits after the point; where these are more than there is
/// room for, by a power of ten: "2.5e-8".
std::string tick_text(double value, int decimals);

/// A kind of surface or a material.
struct KindEntry {
  std::string name;
  Colour colour;
  double area_m2 = 0;
};
/// In the order given; where there is no room for all, the rest is counted.
void draw_kinds(Picture& picture, const std::vector<KindEntry>& kinds);

/// Suns of the period as one who lies on the ground sees them from below, mirrored to agree with a
/// map: the rim is the horizon, the middle the zenith. `places`: azimuth from true north, in the
/// order of time; a jump to another day has elevations below 0 between, or `breaks` at its index.
struct SunTrack {
  std::vector<Horizontal> places;
  std::vector<char> breaks;  ///< whether the path begins anew here
};
/// A disc in the lower left corner with the compass turned as the picture shows north.
void draw_sun_path(Picture& picture, const SunTrack& path, PicturePoint north);

/// Arrow in the lower left corner; `north` in the image, length 1 where it is
/// not foreshortened; none where one looks along it.
void draw_north(Picture& picture, PicturePoint north);

}  // namespace sunload
