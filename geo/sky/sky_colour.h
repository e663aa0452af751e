// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Colour of the clear sky for pictures: the two models of Holubář (2007), 4.3–5.4.
#pragma once

#include "geo/base/vec.h"

namespace sunload {

/// Red, green, blue; 1 is white. The model's author chose them by eye as values of a display; as
/// shares of light (io/plan/light_colour.h) they are taken as they are.
struct Rgb {
  double red = 0, green = 0, blue = 0;
};

/// first: one colour, reddened as a whole towards dusk. second: disc, halo and background
/// of the sky reddened each on its own, so that a low sun stands out.
enum class SkyColourModel { first, second };

/// Of pictures: where the disc ends, 3 degrees from the sun, the sky has some 0.87 of its
/// brightness, so that the whole disc becomes all but white by day.
inline constexpr double picture_gain = 1.15;

/// Colour in [0, 1] of the unit direction `w` on or above the horizon (below counts as on
/// it), sun in the unit direction `sun`, z up. `gain` strengthens the sun of the second
/// model. Brightness follows Kittler's clear sky relative to that at the sun.
Rgb sky_colour(SkyColourModel model, Vec3 w, Vec3 sun, double gain = 1);

/// Colour of parallel sunlight: that of the disc at this elevation of the sun [degrees].
Rgb sunlight_colour(double sun_elevation_deg);

}  // namespace sunload
