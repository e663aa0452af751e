// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Samplers against their densities by chi-squared, on independent uniform numbers.

#include <gtest/gtest.h>

#include <cmath>

#include "solver/base/sampling.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

constexpr std::size_t samples = 1'000'000;

UnitSquare uniform_pair(std::size_t s) {
  const RandomWords w = random_words({.seed = 11, .element = s});
  return {w[0] * 0x1p-32, w[1] * 0x1p-32};
}

/// The triangle is cut into n² congruent ones; number of that which holds b.
constexpr int strips = 9;
std::size_t cell_of(const Barycentric& b) {
  const auto cut = [](double w) { return std::min(strips - 1, static_cast<int>(w * strips)); };
  const int row = cut(b.w1), column = cut(b.w2);
  const bool upper = b.w1 * strips - row + b.w2 * strips - column > 1;
  return static_cast<std::size_t>((row * strips + column) * 2 + (upper ? 1 : 0));
}

/// Counts per cell, and what a density would give: ∫ density dA, midpoint rule.
template <class Density>
Verdict triangle_verdict(Density&& density) {
  constexpr double area = 3.7;
  std::vector<double> counted(2 * strips * strips, 0), expected = counted;
  for (std::size_t s = 0; s < samples; ++s) {
    const UnitSquare x = uniform_pair(s);
    ++counted[cell_of(sample_triangle(x.u, x.v))];
  }
  constexpr double third = 1.0 / 3, cell_area = area / (strips * strips);
  for (int row = 0; row < strips; ++row)
    for (int column = 0; row + column < strips; ++column)
      for (int upper = 0; upper < 2; ++upper) {
        const double shift = upper ? 2 * third : third;
        const Barycentric centre{0, (row + shift) / strips, (column + shift) / strips};
        if (centre.w1 + centre.w2 > 1) continue;
        expected[static_cast<std::size_t>((row * strips + column) * 2 + upper)] =
            samples * cell_area * density(area, centre);
      }
  return expect_counts(counted, expected);
}

TEST(TriangleSampler, FollowsItsDensity) {
  const Verdict verdict = triangle_verdict([](double area, auto&) { return triangle_pdf(area); });
  EXPECT_TRUE(verdict) << verdict.text;
  // Planted faults: a density 2 % too large, and one that leans by 2 % towards corner 1.
  EXPECT_FALSE(triangle_verdict([](double area, auto&) { return 1.02 * triangle_pdf(area); }));
  EXPECT_FALSE(triangle_verdict([](double area, const Barycentric& b) {
    return (1 + 0.02 * (3 * b.w1 - 1)) * triangle_pdf(area);
  }));
}

template <class Density>
Verdict cosine_verdict(Density&& density) {
  constexpr int bands = 10, sectors = 12;
  std::vector<double> counted(bands * sectors, 0), expected = counted;
  for (std::size_t s = 0; s < samples; ++s) {
    const UnitSquare x = uniform_pair(s);
    const Vec3 w = sample_cosine(x.u, x.v);
    const int band = std::min(bands - 1, static_cast<int>(w.z * bands));
    const double turn = std::atan2(w.y, w.x) / (2 * pi) + 0.5;
    const int sector = std::min(sectors - 1, static_cast<int>(turn * sectors));
    ++counted[static_cast<std::size_t>(band * sectors + sector)];
  }
  // dω = d(cosθ) dφ; the density is linear in cosθ, so that the midpoint is exact.
  constexpr double solid_angle = 2 * pi / (bands * sectors);
  for (int band = 0; band < bands; ++band)
    for (int sector = 0; sector < sectors; ++sector)
      expected[static_cast<std::size_t>(band * sectors + sector)] =
          samples * solid_angle * density((band + 0.5) / bands);
  return expect_counts(counted, expected);
}

TEST(CosineSampler, FollowsItsDensity) {
  const Verdict verdict = cosine_verdict(cosine_pdf);
  EXPECT_TRUE(verdict) << verdict.text;
  // Planted faults: 2 % too large, leaning by 2 % to the zenith, cosine dropped.
  EXPECT_FALSE(cosine_verdict([](double mu) { return 1.02 * cosine_pdf(mu); }));
  EXPECT_FALSE(
      cosine_verdict([](double mu) { return (1 + 0.02 * (3 * mu - 2)) * cosine_pdf(mu); }));
  EXPECT_FALSE(cosine_verdict([](double) { return 1 / (2 * pi); }));
}

}  // namespace
}  // namespace sunload::test
