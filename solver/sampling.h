/// Low-discrepancy points and the maps from the unit square to triangles and
/// directions, each as sample, pdf and inverse.
///
/// Sobol points (Joe & Kuo 2008) with nested uniform (Owen) scrambling by hash
/// (Laine & Karras 2011; Burley 2020, Practical Hash-based Owen Scrambling).
/// The seed is added before the hash's bijections, so every single point is
/// exactly uniform over seeds: estimates are unbiased for any number of points.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "geo/units.h"
#include "geo/vec.h"
#include "solver/rng.h"

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

/// The same in [0, 1), scrambled by the dimension's own seed.
inline double scrambled_sobol(std::uint32_t index, int dimension, const RandomWords& seeds) {
  return owen_scrambled(sobol(index, dimension), seeds[static_cast<std::size_t>(dimension)]) *
         0x1p-32;
}

/// Barycentric weights (of corners 0, 1, 2), uniform on a triangle.
/// Heitz (2019), A Low-Distortion Map Between Triangle and Square.
struct Barycentric {
  double w0, w1, w2;
};
constexpr Barycentric sample_triangle(double u, double v) {
  if (v > u) {
    u *= 0.5;
    v -= u;
  } else {
    v *= 0.5;
    u -= v;
  }
  return {1 - u - v, u, v};
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
  if (a == 0 && b == 0) return {0, 0, 1};
  double radius = 0, angle = 0;
  if (std::abs(a) > std::abs(b)) {
    radius = a;
    angle = pi / 4 * (b / a);
  } else {
    radius = b;
    angle = pi / 2 - pi / 4 * (a / b);
  }
  return {radius * std::cos(angle), radius * std::sin(angle),
          std::sqrt(std::max(0.0, 1 - radius * radius))};
}
constexpr double cosine_pdf(double cos_theta) { return cos_theta > 0 ? cos_theta / pi : 0; }
/// The (u, v) that sample_cosine maps to this unit direction (w.z ≥ 0).
UnitSquare invert_cosine(Vec3 w);

}  // namespace sunload
