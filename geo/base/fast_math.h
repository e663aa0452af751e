// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Exponential, sine, cosine, arcsine and arctangent that a compiler can vectorise.
///
/// Straight-line arithmetic, no branches, no tables, no calls: loops over them become
/// vector code on every instruction set, and the same bits on each of them (no fused
/// multiply-add). Errors are measured in tests/geo/base/fast_math_test.cpp.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace sunload {

namespace fast_math_detail {

// Horner's rule. The coefficients are those of the lowest power first.
template <std::size_t N>
inline double polynomial(const std::array<double, N>& coefficients, double x) {
  double sum = coefficients[N - 1];
  for (std::size_t i = N - 1; i-- > 0;) sum = sum * x + coefficients[i];
  return sum;
}

// 1/k!, so that exp(r) for |r| ≤ ln 2 / 2 ends with a remainder of 5e-15.
inline constexpr std::array<double, 12> exp_series{
    1,         1,          1.0 / 2,     1.0 / 6,      1.0 / 24,      1.0 / 120,
    1.0 / 720, 1.0 / 5040, 1.0 / 40320, 1.0 / 362880, 1.0 / 3628800, 1.0 / 39916800};

// sin(x)/x in powers of x², so that the remainder for x ≤ pi/2 is 3e-16.
inline constexpr std::array<double, 10> sine_series{1,
                                                    -1.0 / 6,
                                                    1.0 / 120,
                                                    -1.0 / 5040,
                                                    1.0 / 362880,
                                                    -1.0 / 39916800,
                                                    1.0 / 6227020800,
                                                    -1.0 / 1307674368000,
                                                    1.0 / 355687428096000,
                                                    -1.0 / 121645100408832000.0};

// cos(x) in powers of x², so that the remainder for x ≤ pi/4 is 2e-18.
inline constexpr std::array<double, 9> cosine_series{1,
                                                     -1.0 / 2,
                                                     1.0 / 24,
                                                     -1.0 / 720,
                                                     1.0 / 40320,
                                                     -1.0 / 3628800,
                                                     1.0 / 479001600,
                                                     -1.0 / 87178291200,
                                                     1.0 / 20922789888000};

// (asin r - r) / r³ as a polynomial in r² on [0, 1/4], through the Chebyshev nodes.
inline constexpr std::array<double, 12> asin_tail{
    0.16666666666666649,   0.075000000000207637, 0.044642857103423646,  0.03038194736709848,
    0.02237204763174451,   0.017355259955786323, 0.013929652902326633,  0.011875494382636922,
    0.0078029494773533175, 0.016035514349148822, -0.010749050339697804, 0.02816921806088141};

// (4/pi)·atan(t)/t as a polynomial in t² on [0, 1], through the Chebyshev nodes.
inline constexpr std::array<double, 15> octant_series{
    1.2732395447347933,    -0.4244131814118654,    0.25464789638551893,   -0.18189098634325207,
    0.14146507222002347,   -0.1156911371096396,    0.09757060450211609,   -0.083221849966839498,
    0.069496463177757942,  -0.053889375816934725,  0.036173514832020921,  -0.019394611063494688,
    0.0075584294350431753, -0.0018674205030824039, 0.00021703692802706677};

}  // namespace fast_math_detail

/// e^x within 2e-14 relative for |x| ≤ 700; beyond, the value at that limit.
inline double fast_exp(double x) {
  constexpr double limit = 700;
  constexpr double log2_e = 1.4426950408889634;
  // ln 2 in two parts: the first has few bits, so that its multiples are exact.
  constexpr double ln2_high = 0.69314718036912382, ln2_low = 1.9082149292705877e-10;
  // Adding 1.5·2^52 leaves the nearest integer in the last bits.
  constexpr double rounder = 6755399441055744.0;
  x = x < -limit ? -limit : x;
  x = x > limit ? limit : x;
  const double shifted = x * log2_e + rounder;
  const double k = shifted - rounder;
  const double r = (x - k * ln2_high) - k * ln2_low;
  const auto exponent = std::bit_cast<std::uint64_t>(shifted) << 52;
  const double scale = std::bit_cast<double>(exponent + std::bit_cast<std::uint64_t>(1.0));
  return fast_math_detail::polynomial(fast_math_detail::exp_series, r) * scale;
}

/// sin(x) within 1e-15 for x in [0, pi/2].
inline double fast_sin(double x) {
  return x * fast_math_detail::polynomial(fast_math_detail::sine_series, x * x);
}

/// cos(x) within 1e-15 for x in [0, pi/4].
inline double fast_cos(double x) {
  return fast_math_detail::polynomial(fast_math_detail::cosine_series, x * x);
}

/// asin(x) within 1e-15 for x in [0, 1]; above 1 counts as 1.
inline double fast_asin(double x) {
  constexpr double half_pi = 1.5707963267948966;
  // Above 1/2: asin x = pi/2 - 2 asin(sqrt((1 - x)/2)).
  const double folded = 0.5 - 0.5 * x;
  const double folded_square = folded > 0 ? folded : 0;
  const bool large = x > 0.5;
  const double square = large ? folded_square : x * x;
  const double root = std::sqrt(folded_square);
  const double r = large ? root : x;
  const double small_asin =
      r + r * square * fast_math_detail::polynomial(fast_math_detail::asin_tail, square);
  return large ? half_pi - 2 * small_asin : small_asin;
}

/// (4/pi)·atan(t) within 3e-13 relative for t in [0, 1]: an octant is the unit.
inline double fast_octant(double t) {
  // Even and odd powers apart: half the latency of one chain.
  constexpr auto& c = fast_math_detail::octant_series;
  const double square = t * t, fourth = square * square;
  double even = c[14], odd = c[13];
  for (std::size_t i = 12; i > 0; i -= 2) {
    even = even * fourth + c[i];
    odd = odd * fourth + c[i - 1];
  }
  even = even * fourth + c[0];
  return t * (even + odd * square);
}

}  // namespace sunload
