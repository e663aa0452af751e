// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Colour of sun and sky: the light of an interval in three bands.
///
/// Colours are those of Holubář (2007; geo/sky/sky_colour.h), divided by their mean over the bands:
/// in every direction the mean of the bands is the broadband radiance. The sunlight has the colour
/// of the disc at its elevation, a cell of the sky that of the second model at its middle, as far
/// as the sky is clear: the rest of its light is white, as clouds are.
#pragma once

#include <vector>

#include "geo/sky/sky.h"
#include "io/plan/light_series.h"

namespace sunload {

/// How much of the sky's light has the colour of a clear sky, 0 … 1: by Perez's clearness from 1
/// (overcast) to 6.2 (the brightest bin) for `perez`; 0 for overcast and uniform skies, 1 for
/// clear ones; CIE types 1-5 are overcast, 6-10 half clear, 11-15 clear (ISO 15469:2004).
double blue_share(const LitInterval& interval, const LightStudy& light);

/// Red, green and blue of `sun`, which is the broadband light of `interval` under an open horizon
/// with the means `source`. The far ground is grey and has the colours of what lights it.
std::vector<IntervalLight::Band> light_in_bands(const IntervalLight& sun, const Irradiance& source,
                                                const LitInterval& interval,
                                                const LightStudy& light, const SkyGrid& grid);

}  // namespace sunload
