// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/base/sampling.h"

namespace sunload {

namespace {

/// Primitive polynomial (degree, inner coefficients) and first direction
/// numbers of a Sobol dimension: Joe & Kuo (2008), table new-joe-kuo-6.
struct Polynomial {
  int degree;
  std::uint32_t coefficients;
  std::array<std::uint32_t, 3> first;
};
constexpr std::array<Polynomial, sobol_dimensions - 1> polynomials{
    Polynomial{1, 0, {1, 0, 0}}, Polynomial{2, 1, {1, 3, 0}}, Polynomial{3, 1, {1, 3, 1}}};

constexpr std::array<std::uint32_t, 32> directions_of(const Polynomial& p) {
  std::array<std::uint32_t, 32> v{};
  for (int i = 0; i < 32; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (i < p.degree) {
      v[at] = p.first[at] << (31 - i);
      continue;
    }
    const auto back = [&](int k) { return v[static_cast<std::size_t>(i - k)]; };
    v[at] = back(p.degree) ^ (back(p.degree) >> p.degree);
    for (int k = 1; k < p.degree; ++k)
      if (p.coefficients >> (p.degree - 1 - k) & 1u) v[at] ^= back(k);
  }
  return v;
}

constexpr auto all_directions() {
  std::array<std::array<std::uint32_t, 32>, sobol_dimensions> all{};
  for (std::size_t bit = 0; bit < 32; ++bit) all[0][bit] = 1u << (31 - bit);
  for (std::size_t d = 1; d < sobol_dimensions; ++d) all[d] = directions_of(polynomials[d - 1]);
  return all;
}

}  // namespace

const std::array<std::array<std::uint32_t, 32>, sobol_dimensions> sobol_directions =
    all_directions();

UnitSquare invert_cosine(Vec3 w) {
  const double x = w.x, y = w.y;
  const double radius = std::hypot(x, y);
  if (radius == 0) return {0.5, 0.5};
  double a = 0, b = 0;
  if (std::abs(x) > std::abs(y)) {
    a = std::copysign(radius, x);
    b = a * std::atan(y / x) / (pi / 4);
  } else {
    b = std::copysign(radius, y);
    a = b * std::atan(x / y) / (pi / 4);
  }
  return {(a + 1) / 2, (b + 1) / 2};
}

}  // namespace sunload
