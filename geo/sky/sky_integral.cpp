// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Horizontal irradiance of a relative sky.
//
// In rings about the sun the cusp exp(dγ) falls on the pole of the coordinates and
// vanishes: ∫ indicatrix(γ) sinγ · ring(γ) dγ, ring(γ) = ∫ gradation(μ) μ dψ over the part
// of the ring above the horizon, μ = cosθ. Both integrals by Gauss-Legendre points between
// the places where the integrand is not smooth.
#include <algorithm>
#include <array>
#include <cmath>

#include "geo/sky/sky.h"

namespace sunload {

namespace {

template <std::size_t N>
struct GaussLegendre {
  std::array<double, N> node{}, weight{};  // on [-1, 1]

  GaussLegendre() {
    const auto n = static_cast<double>(N);
    for (std::size_t i = 0; i < N; ++i) {
      double x = std::cos(pi * (static_cast<double>(i) + 0.75) / (n + 0.5));  // Tricomi
      double slope = 1;
      for (int iteration = 0; iteration < 8; ++iteration) {  // Newton, converges in 4
        double p = 1, previous = 0;
        for (std::size_t k = 1; k <= N; ++k) {
          const auto degree = static_cast<double>(k);
          const double next = ((2 * degree - 1) * x * p - (degree - 1) * previous) / degree;
          previous = p;
          p = next;
        }
        slope = n * (x * p - previous) / (x * x - 1);
        x -= p / slope;
      }
      node[i] = x;
      weight[i] = 2 / ((1 - x * x) * slope * slope);
    }
  }
};

constexpr std::size_t ring_count = 24, ring_points = 32;

// Places on the sphere: a band of zenith cosines, seen from the sun.
struct Band {
  double low, high;  // cosines of the zenith angle
};
struct Sun {
  double cosine, sine;  // of its zenith angle
};

// Angle about the sun at which the ring (cosine, sine of γ) crosses a zenith cosine,
// 0 or pi where all of it lies on one side.
double crossing(const Sun& sun, double ring_cosine, double ring_sine, double cos_zenith) {
  const double height = cos_zenith - ring_cosine * sun.cosine;
  const double reach = ring_sine * sun.sine;
  if (height >= reach) return 0;
  if (height <= -reach) return pi;
  return std::acos(height / reach);
}

double ring_integral(const SkyShape& shape, const Sun& sun, const Band& band, double ring_cosine,
                     double ring_sine) {
  static const GaussLegendre<ring_points> gauss;
  const double begin = band.high < 1 ? crossing(sun, ring_cosine, ring_sine, band.high) : 0;
  const double end = crossing(sun, ring_cosine, ring_sine, band.low);
  if (end <= begin) return 0;
  const double middle = 0.5 * (begin + end), half = 0.5 * (end - begin);

  std::array<double, ring_points> value;
  for (std::size_t i = 0; i < ring_points; ++i) {
    const double half_sine = fast_sin(0.5 * (middle + half * gauss.node[i]));
    value[i] = ring_cosine * sun.cosine + ring_sine * sun.sine * (1 - 2 * half_sine * half_sine);
  }
  for (std::size_t i = 0; i < ring_points; ++i) {
    const double cos_zenith = std::clamp(value[i], band.low, band.high);
    value[i] = gauss.weight[i] * shape.gradation(cos_zenith) * cos_zenith;
  }
  double sum = 0;
  for (const double v : value) sum += v;
  return 2 * half * sum;  // both sides of the sun's meridian
}

// Rings with γ in [begin, end], between which none touches a border of the band. There the
// integrand grows like a power 1.5 of the distance to `begin` and `end`; the sine makes it
// smooth.
double panel_integral(const SkyShape& shape, const Sun& sun, const Band& band, double begin,
                      double end) {
  static const GaussLegendre<ring_count> gauss;
  const double middle = 0.5 * (begin + end), half = 0.5 * (end - begin);
  double sum = 0;
  for (std::size_t i = 0; i < ring_count; ++i) {
    const double t = 0.5 * pi * gauss.node[i];
    const double angle = middle + half * std::sin(t);
    const double half_chord = std::sin(0.5 * angle);
    const double sine = std::sin(angle);
    sum += gauss.weight[i] * std::cos(t) * shape.indicatrix(4 * half_chord * half_chord) * sine *
           ring_integral(shape, sun, band, std::cos(angle), sine);
  }
  return half * 0.5 * pi * sum;
}

double band_integral(const SkyShape& shape, const Sun& sun, const Band& band) {
  const double zenith = std::atan2(sun.sine, sun.cosine);
  const double low = std::acos(band.low), high = std::acos(band.high);
  std::array<double, 6> borders{
      0, std::abs(zenith - low), zenith + low, std::abs(zenith - high), zenith + high, pi};
  std::sort(borders.begin(), borders.end());
  constexpr double negligible = 1e-12;  // width of a panel
  double sum = 0;
  for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
    const double begin = borders[i], end = std::min(borders[i + 1], pi);
    if (end - begin < negligible || begin > zenith + low) continue;
    sum += panel_integral(shape, sun, band, begin, end);
  }
  return sum;
}

}  // namespace

double horizontal_integral(const SkyShape& shape, double sun_cos_zenith) {
  const double cosine = std::clamp(sun_cos_zenith, 0.0, 1.0);
  const Sun sun{cosine, std::sqrt((1 - cosine) * (1 + cosine))};
  // Below the floor the gradation is constant: a kink, unless it has died down by there.
  constexpr double died_down = -18;  // exp(-18) = 1.5e-8
  const bool kink = shape.v != 0 && shape.b / shape.cos_floor > died_down;
  if (!kink) return band_integral(shape, sun, {0, 1});
  return band_integral(shape, sun, {0, shape.cos_floor}) +
         band_integral(shape, sun, {shape.cos_floor, 1});
}

}  // namespace sunload
