// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Notation of docs/developer/method.md, Sources of light: I relative brightness, k share of day, h
// height on the unit dome.
#include "geo/sky/sky_colour.h"

#include <algorithm>
#include <cmath>

#include "geo/sky/kittler.h"

namespace sunload {

namespace {

// Scattering coefficients at 700, 541 and 435.8 nm divided by the largest, eqs 4.4-4.6.
constexpr Rgb rayleigh{0.150, 0.420, 1}, mie{0.402, 0.662, 1};
constexpr Rgb reddening_1{1, 0.65, 0.5}, reddening_2{0.910, 0.557, 0.373};
constexpr Rgb white{1, 1, 1};
constexpr double full_day_deg = 40;                    // elevation of the sun
constexpr double disc_edge_deg = 3, disc_end_deg = 4;  // angle to the sun
constexpr double background_light = 0.1;               // of the first model

Rgb operator+(Rgb a, Rgb b) { return {a.red + b.red, a.green + b.green, a.blue + b.blue}; }
Rgb operator*(Rgb a, Rgb b) { return {a.red * b.red, a.green * b.green, a.blue * b.blue}; }
Rgb operator*(Rgb a, double s) { return {a.red * s, a.green * s, a.blue * s}; }
Rgb mix(Rgb a, Rgb b, double t) { return a * (1 - t) + b * t; }
Rgb clamped(Rgb a) {
  return {std::clamp(a.red, 0.0, 1.0), std::clamp(a.green, 0.0, 1.0), std::clamp(a.blue, 0.0, 1.0)};
}

double smoothstep(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// Kittler's clear sky at the direction relative to the sun, in [0, 1].
double brightness(double cos_zenith, double sun_cos_zenith, double chord_squared) {
  const SkyShape clear = kittler_clear_sky();
  const double at_sun = clear.gradation(sun_cos_zenith) * clear.indicatrix(0);
  return std::min(1.0, clear.gradation(cos_zenith) * clear.indicatrix(chord_squared) / at_sun);
}

}  // namespace

Rgb sky_colour(SkyColourModel model, Vec3 w, Vec3 sun, double gain) {
  const double h = std::clamp(w.z, 0.0, 1.0);
  const Vec3 chord = w - sun;
  const double I = brightness(h, std::clamp(sun.z, 0.0, 1.0), dot(chord, chord));
  const double k = smoothstep(0, full_day_deg, degrees(std::asin(std::clamp(sun.z, -1.0, 1.0))));
  const Rgb blue = mix(mie, rayleigh, h);
  if (model == SkyColourModel::first) {
    const Rgb day = (blue + white * background_light) * (1 - I) + white * I;
    return clamped(day * (day * reddening_1 + white * k));
  }
  const double angle_deg = degrees(2 * std::asin(std::min(1.0, norm(chord) / 2)));
  const Rgb bright = white * (I * gain);
  const Rgb background = mix(reddening_2, white, k) * blue * (1 - I);
  const Rgb disc = mix(reddening_1, white, k) * bright;
  const Rgb halo = mix(reddening_2 * reddening_2, white, k) * bright;
  return clamped(background + mix(disc, halo, smoothstep(disc_edge_deg, disc_end_deg, angle_deg)));
}

Rgb sunlight_colour(double sun_elevation_deg) {
  return mix(reddening_1, white, smoothstep(0, full_day_deg, sun_elevation_deg));
}

}  // namespace sunload
