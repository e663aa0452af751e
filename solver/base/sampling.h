// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Low-discrepancy points and the maps from the unit square to triangles and
/// directions, each as sample, pdf and inverse.
///
/// Sobol points (Joe & Kuo 2008) with nested uniform (Owen) scrambling by hash
/// (Laine & Karras 2011; Burley 2020, Practical Hash-based Owen Scrambling).
/// The seed is added before the hash's bijections, so every single point is
/// exactly uniform over seeds: estimates are unbiased for any number of points.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "geo/base/fast_math.h"
#include "geo/base/units.h"
#include "geo/base/vec.h"
#include "solver/base/rng.h"

namespace sunload {

constexpr std::uint32_t reversed_bits(std::uint32_t x) {
  x = ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
  x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0fu);
  return __builtin_bswap32(x);
}

/// Owen scrambling of a binary fraction x / 2^32.
constexpr std::uint32_t owen_scrambled(std::uint32_t x, std::uint32_t seed) {
  x = reversed_bits(x) + seed;
  x ^= x * 0x6c50b47cu;
  x ^= x * 0xb82f1e52u;
  x ^= x * 0xc7afe638u;
  x ^= x * 0x8d22f6e6u;
  return reversed_bits(x);
}

inline constexpr int sobol_dimensions = 4;
/// Direction numbers [dimension][bit] of the first four Sobol dimensions.
extern const std::array<std::array<std::uint32_t, 32>, sobol_dimensions> sobol_directions;

/// Coordinate of Sobol point `index` as a binary fraction x / 2^32.
inline std::uint32_t sobol(std::uint32_t index, int dimension) {
  std::uint32_t x = 0;
  for (int bit = 0; index != 0; index >>= 1, ++bit)
    if (index & 1u)
      x ^= sobol_directions[static_cast<std::size_t>(dimension)][static_cast<std::size_t>(bit)];
  return x;
}

/// A scrambled coordinate in [0, 1).
constexpr double scrambled(std::uint32_t coordinate, std::uint32_t seed) {
  return owen_scrambled(coordinate, seed) * 0x1p-32;
}
/// Sobol point in [0, 1), scrambled by the dimension's own seed.
inline double scrambled_sobol(std::uint32_t index, int dimension, const RandomWords& seeds) {
  return scrambled(sobol(index, dimension), seeds[static_cast<std::size_t>(dimension)]);
}

/// Coordinates of the `count` Sobol points from `first`, a multiple of `count`, on.
template <std::size_t count>
void sobol_points(std::uint32_t first, int dimension, std::uint32_t (&x)[count]) {
  static_assert((count & (count - 1)) == 0, "points of a packet share their higher bits");
  const auto& directions = sobol_directions[static_cast<std::size_t>(dimension)];
  x[0] = sobol(first, dimension);
  for (std::size_t l = 1; l < count; ++l)
    x[l] = x[l & (l - 1)] ^ directions[static_cast<std::size_t>(std::countr_zero(l))];
}

/// Barycentric weights (of corners 0, 1, 2), uniform on a triangle.
/// Heitz (2019), A Low-Distortion Map Between Triangle and Square.
struct Barycentric {
  double w0, w1, w2;
};
/// Weights for a point (u, v) of the unit square; keeps areas in proportion.
constexpr Barycentric sample_triangle(double u, double v) {
  const double half = 0.5 * (u < v ? u : v);
  const double w1 = v > u ? half : u - half;
  const double w2 = v > u ? v - half : half;
  return {1 - w1 - w2, w1, w2};
}
/// Density with respect to the unit square of barycentrics per area: 1 / area.
constexpr double triangle_pdf(double area) { return 1 / area; }
/// The (u, v) that sample_triangle maps to these weights.
struct UnitSquare {
  double u, v;
};
constexpr UnitSquare invert_triangle(Barycentric b) {
  return b.w2 > b.w1 ? UnitSquare{2 * b.w1, b.w2 + b.w1} : UnitSquare{b.w1 + b.w2, 2 * b.w2};
}

/// Direction about +z with density cosθ/π, by way of the concentric map of the
/// square to the disc (Shirley & Chiu 1997), which keeps strata compact.
inline Vec3 sample_cosine(double u, double v) {
  const double a = 2 * u - 1, b = 2 * v - 1;
  const bool along_a = std::abs(a) > std::abs(b);
  const double radius = along_a ? a : b, across = along_a ? b : a;
  const double angle = pi / 4 * (across / (radius != 0 ? radius : 1.0));  // from the nearest axis
  const double sign = angle < 0 ? -1.0 : 1.0;
  const double near = radius * fast_cos(sign * angle);
  const double far = radius * (sign * fast_sin(sign * angle));
  const double square = 1 - radius * radius;
  return {along_a ? near : far, along_a ? far : near, std::sqrt(square > 0 ? square : 0.0)};
}
/// Density [sr-1] with which sample_cosine draws a direction at this cosine to +z.
constexpr double cosine_pdf(double cos_theta) { return cos_theta > 0 ? cos_theta / pi : 0; }
/// The (u, v) that sample_cosine maps to this unit direction (w.z ≥ 0).
UnitSquare invert_cosine(Vec3 w);

}  // namespace sunload
