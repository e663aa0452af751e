// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Colours that stand for numbers: perceptually uniform, safe for colour-blind eyes.
///
/// `false_colour` is a helix in CIELAB: lightness and hue grow linearly from a
/// dark blue by way of purple and orange to a light yellow, chroma is constant,
/// so that equal steps of the value are equal steps of CIE 1976 colour
/// difference; lightness alone orders the colours for any colour vision.
/// `grey` is the neutral axis. `hue` is the scale of the historic system (docs/developer/method.md,
/// The historic system): HLS hue from cold (blue) to warm (red), lightness and saturation ½;
/// neither uniform nor safe, it is for pictures that are compared with old ones. `difference` is of
/// two arms in CIELAB, from blue (less) by a light neutral grey at the middle (0) to red (more): on
/// either side lightness falls and chroma grows linearly, alike, and every colour vision tells the
/// two apart. CIE 15:2004, Colorimetry; sRGB: IEC 61966-2-1.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace sunload {

/// sRGB, encoded, 0 … 1.
struct Colour {
  double red = 0, green = 0, blue = 0;
};

/// Of what has no value: backs of surfaces, values that are not known (`no_value_colour`).
inline constexpr Colour back_colour{0.72, 0.72, 0.72};

/// CIELAB coordinates (CIE 1976): lightness 0 … 100, a from green to red, b from blue to yellow.
struct Lab {
  double lightness = 0, a = 0, b = 0;
};

/// Colour of CIELAB coordinates (white point D65); channels may leave [0, 1].
Colour srgb_from_lab(Lab lab);
/// Inverse of `srgb_from_lab`.
Lab lab_from_srgb(Colour colour);

/// Light that an encoded sRGB channel stands for, 0 … 1, and back.
double linear_from_srgb(double channel);
double srgb_from_linear(double channel);

/// The palettes described at the head of this file.
enum class Palette { false_colour, grey, hue, difference };

/// Colour of `share` in [0, 1]; beyond, that of the nearer end.
Colour map_colour(Palette palette, double share);
/// Of what has no value, beside the colours of a palette.
Colour no_value_colour(Palette palette);

/// Round ticks 0, step, 2·step … ≤ `largest`, with a step of 1, 2, 2.5 or 5
/// times a power of ten, at most `count` steps. Heckbert (1990), Nice Numbers
/// for Graph Labels.
struct Ticks {
  double step = 1;
  std::vector<double> values;
  int decimals = 0;  ///< digits after the point that tell the ticks apart
};
Ticks round_ticks(double largest, int count);

/// Smallest number 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8 × 10^n that is ≥ `value` > 0.
double rounded_up(double value);

}  // namespace sunload
