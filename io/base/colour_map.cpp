// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/colour_map.h"

#include <algorithm>
#include <cmath>

#include "geo/base/units.h"

namespace sunload {
namespace {

// D65 white of the 2° observer, Y = 1 (IEC 61966-2-1).
constexpr std::array<double, 3> white{0.95047, 1.0, 1.08883};
// Linear sRGB from XYZ and back (IEC 61966-2-1, the digits of its primaries).
constexpr std::array<std::array<double, 3>, 3> rgb_from_xyz{{{3.2404542, -1.5371385, -0.4985314},
                                                             {-0.9692660, 1.8760108, 0.0415560},
                                                             {0.0556434, -0.2040259, 1.0572252}}};
constexpr std::array<std::array<double, 3>, 3> xyz_from_rgb{{{0.4124564, 0.3575761, 0.1804375},
                                                             {0.2126729, 0.7151522, 0.0721750},
                                                             {0.0193339, 0.1191920, 0.9503041}}};
// CIE 15:2004, 8.2.1: the cube root continues as a line below (6/29)³.
constexpr double lab_knee = 6.0 / 29;
constexpr double lab_offset = 4.0 / 29;
constexpr double lightness_scale = 116, lightness_offset = 16, a_scale = 500, b_scale = 200;

// Ends of the helix: the widest constant chroma that stays within sRGB for
// these lightnesses and hues is 60, found by search; dark enough for shadow,
// and far enough from white paper at the light end.
constexpr double darkest = 12, lightest = 92;
constexpr double chroma = 58;
constexpr double first_hue_deg = 305, last_hue_deg = 458;

// Rounding of decimal fractions such as 3 × 0.1 must not push a tick out.
constexpr double tick_tolerance = 1e-9;
constexpr int most_decimals = 9;

double cubed(double x) { return x * x * x; }

double from_lab_scale(double f) {
  return f > lab_knee ? cubed(f) : 3 * lab_knee * lab_knee * (f - lab_offset);
}

double to_lab_scale(double t) {
  return t > cubed(lab_knee) ? std::cbrt(t) : t / (3 * lab_knee * lab_knee) + lab_offset;
}

std::array<double, 3> product(const std::array<std::array<double, 3>, 3>& matrix,
                              const std::array<double, 3>& v) {
  std::array<double, 3> result{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) result[i] += matrix[i][k] * v[k];
  return result;
}

Colour clamped(Colour c) {
  return {std::clamp(c.red, 0.0, 1.0), std::clamp(c.green, 0.0, 1.0), std::clamp(c.blue, 0.0, 1.0)};
}

/// HLS with lightness and saturation ½ (Foley et al. 1990, Computer Graphics, fig. 13.37): channels
/// lie between ¼ and ¾.
Colour hue_colour(double hue_deg) {
  constexpr double low = 0.25, high = 0.75, sextant_deg = 60;
  const auto channel = [&](double shift_deg) {
    const double h = std::fmod(hue_deg + shift_deg, 6 * sextant_deg) / sextant_deg;
    const double rise = std::clamp(std::min(h, 4 - h), 0.0, 1.0);
    return low + (high - low) * rise;
  };
  constexpr double of_red = 120, of_blue = 240;
  return {channel(of_red), channel(0), channel(of_blue)};
}

/// `part` in [−1, 1]; of one lightness and chroma the ends are within sRGB.
Colour difference_colour(double part) {
  constexpr double neutral_lightness = 94, end_lightness = 35, end_chroma = 46;
  constexpr double blue_deg = 282, red_deg = 28;
  const double size = std::abs(part), hue = radians(part < 0 ? blue_deg : red_deg);
  return srgb_from_lab({neutral_lightness + (end_lightness - neutral_lightness) * size,
                        end_chroma * size * std::cos(hue), end_chroma * size * std::sin(hue)});
}

}  // namespace

// IEC 61966-2-1, 5.2: a power of 2.4 with a linear toe.
double linear_from_srgb(double channel) {
  constexpr double toe = 0.04045, toe_slope = 12.92, offset = 0.055, exponent = 2.4;
  return channel <= toe ? channel / toe_slope
                        : std::pow((channel + offset) / (1 + offset), exponent);
}

double srgb_from_linear(double channel) {
  constexpr double toe = 0.0031308, toe_slope = 12.92, offset = 0.055, exponent = 2.4;
  return channel <= toe ? channel * toe_slope
                        : (1 + offset) * std::pow(channel, 1 / exponent) - offset;
}

Colour srgb_from_lab(Lab lab) {
  const double f = (lab.lightness + lightness_offset) / lightness_scale;
  const auto rgb = product(
      rgb_from_xyz, {white[0] * from_lab_scale(f + lab.a / a_scale), white[1] * from_lab_scale(f),
                     white[2] * from_lab_scale(f - lab.b / b_scale)});
  return {srgb_from_linear(rgb[0]), srgb_from_linear(rgb[1]), srgb_from_linear(rgb[2])};
}

Lab lab_from_srgb(Colour colour) {
  const auto xyz =
      product(xyz_from_rgb, {linear_from_srgb(colour.red), linear_from_srgb(colour.green),
                             linear_from_srgb(colour.blue)});
  const double x = to_lab_scale(xyz[0] / white[0]), y = to_lab_scale(xyz[1] / white[1]),
               z = to_lab_scale(xyz[2] / white[2]);
  return {lightness_scale * y - lightness_offset, a_scale * (x - y), b_scale * (y - z)};
}

Colour map_colour(Palette palette, double share) {
  const double t = std::clamp(share, 0.0, 1.0);
  if (palette == Palette::difference) return clamped(difference_colour(2 * t - 1));
  constexpr double cold_hue_deg = 240;
  if (palette == Palette::hue) return hue_colour(cold_hue_deg * (1 - t));
  const double lightness = darkest + (lightest - darkest) * t;
  if (palette == Palette::grey) return clamped(srgb_from_lab({lightness, 0, 0}));
  const double hue = radians(first_hue_deg + (last_hue_deg - first_hue_deg) * t);
  return clamped(srgb_from_lab({lightness, chroma * std::cos(hue), chroma * std::sin(hue)}));
}

Colour no_value_colour(Palette palette) {
  constexpr Colour pale_blue{0.56, 0.70, 0.90};
  return palette == Palette::grey ? pale_blue : back_colour;
}

Ticks round_ticks(double largest, int count) {
  Ticks ticks;
  const double rough = largest / count;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double digit : {1.0, 2.0, 2.5, 5.0, 10.0}) {
    ticks.step = digit * power;
    if (ticks.step * count >= largest * (1 - tick_tolerance)) break;
  }
  for (int k = 0; k * ticks.step <= largest * (1 + tick_tolerance); ++k)
    ticks.values.push_back(k * ticks.step);
  for (double scaled = ticks.step; ticks.decimals < most_decimals; ++ticks.decimals, scaled *= 10)
    if (std::abs(scaled - std::round(scaled)) < tick_tolerance * scaled) break;
  return ticks;
}

double rounded_up(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double digit : {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0})
    if (digit * power >= value * (1 - tick_tolerance)) return digit * power;
  return 10 * power;
}

}  // namespace sunload
