// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Patches in the colours of their light: red, green and blue as what they are.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/base/colour_map.h"
#include "io/result/reader.h"

namespace sunload {

/// A colour for every patch, with the value that they are scaled by.
struct BandColours {
  std::vector<Colour> of_patches;  ///< linear light, 0 … 1
  double white = 1;                ///< value of all bands that is white
};

/// Colours by a dataset [patch], or [time, patch] at `time`. White is `largest` where given, else
/// what all but 0.5 % of the area stay below in every band. Throws InputError unless `result` shows
/// all bands of a result in bands.
BandColours colours_of_bands(const ResultReader& result, const std::string& dataset,
                             const std::string& time, const std::optional<double>& largest,
                             const std::vector<double>& area);

/// For the title of a picture: the band that is shown, or that it is of all; of results without
/// bands nothing.
std::string band_title(const ResultReader& result);

}  // namespace sunload
