// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Low-discrepancy points: first points, nets, scrambling; maps and their inverses.

#include "solver/base/sampling.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

constexpr double word_range = 4294967296.0;  // 2^32

// The sequence as Joe & Kuo print it follows the Gray code of the index.
TEST(Sobol, FirstPointsAreThePublishedOnes) {
  constexpr double published[8][sobol_dimensions] = {{0, 0, 0, 0},
                                                     {0.5, 0.5, 0.5, 0.5},
                                                     {0.75, 0.25, 0.25, 0.25},
                                                     {0.25, 0.75, 0.75, 0.75},
                                                     {0.375, 0.375, 0.625, 0.875},
                                                     {0.875, 0.875, 0.125, 0.375},
                                                     {0.625, 0.125, 0.875, 0.625},
                                                     {0.125, 0.625, 0.375, 0.125}};
  for (std::uint32_t i = 0; i < 8; ++i)
    for (int d = 0; d < sobol_dimensions; ++d)
      EXPECT_EQ(sobol(i ^ (i >> 1), d) / word_range, published[i][d]) << i << " " << d;
}

struct Pair {
  std::uint32_t x, y;
};

/// Do these 2^m points form a (t, m, 2)-net in base 2: 2^t in every elementary interval of
/// area 2^(t - m)?
bool is_net(const std::vector<Pair>& points, int m, int t) {
  for (int a = 0; a <= m - t; ++a) {
    const int b = m - t - a;
    std::vector<int> count(std::size_t{1} << (m - t), 0);
    for (const auto& p : points) {
      const std::size_t column = a == 0 ? 0 : p.x >> (32 - a);
      const std::size_t row = b == 0 ? 0 : p.y >> (32 - b);
      ++count[(column << b) + row];
    }
    for (const int c : count)
      if (c != 1 << t) return false;
  }
  return true;
}

/// 2^m points from `first` on, scrambled by `seeds` unless both are 0.
std::vector<Pair> points(std::uint32_t first, int m, int dim_x, int dim_y, Pair seeds) {
  std::vector<Pair> result;
  for (std::uint32_t i = first; i < first + (1u << m); ++i) {
    Pair p{sobol(i, dim_x), sobol(i, dim_y)};
    if (seeds.x || seeds.y) p = {owen_scrambled(p.x, seeds.x), owen_scrambled(p.y, seeds.y)};
    result.push_back(p);
  }
  return result;
}

constexpr int largest_m = 12;

// Direction by dimensions 0 and 1: t = 0. Place on the triangle by 2 and 3, whose
// polynomials have degree 2 and 3: t is at most (2 - 1) + (3 - 1) (Sobol 1967).
TEST(Sobol, PrefixesAndAlignedBlocksAreNets) {
  for (int m = 0; m <= largest_m; ++m)
    for (const std::uint32_t block : {0u, 1u, 5u}) {
      const std::uint32_t first = block << m;
      EXPECT_TRUE(is_net(points(first, m, 0, 1, {}), m, 0)) << m;
      EXPECT_TRUE(is_net(points(first, m, 2, 3, {}), m, std::min(m, 3))) << m;
    }
  // Planted fault: the same dimension twice.
  EXPECT_FALSE(is_net(points(0, 4, 1, 1, {}), 4, 0));
}

TEST(Sobol, EveryDimensionIsStratified) {
  for (int d = 0; d < sobol_dimensions; ++d)
    for (int m = 0; m <= largest_m; ++m) {
      std::vector<int> count(std::size_t{1} << m, 0);
      for (std::uint32_t i = 0; i < 1u << m; ++i) ++count[m == 0 ? 0 : sobol(i, d) >> (32 - m)];
      for (const int c : count) ASSERT_EQ(c, 1) << d << " " << m;
    }
}

TEST(OwenScrambling, KeepsTheNets) {
  for (std::uint64_t e = 0; e < 20; ++e) {
    const RandomWords seeds = random_words({.element = e});
    for (int m = 1; m <= 10; ++m) {
      EXPECT_TRUE(is_net(points(0, m, 0, 1, {seeds[0], seeds[1]}), m, 0));
      EXPECT_TRUE(is_net(points(0, m, 2, 3, {seeds[2], seeds[3]}), m, std::min(m, 3)));
    }
  }
  // Planted fault: each point gets a seed of its own.
  auto loose = points(0, 8, 0, 1, {});
  for (std::uint64_t i = 0; i < loose.size(); ++i)
    loose[i].x = owen_scrambled(loose[i].x, random_words({.element = i})[0]);
  EXPECT_FALSE(is_net(loose, 8, 0));
}

/// Chi-squared of the value of one point over many seeds in 256 cells.
template <class Seed>
Verdict uniform_over_seeds(std::uint32_t index, int dimension, Seed&& seed) {
  constexpr std::size_t cells = 256, seeds = 1 << 16;
  std::vector<double> counted(cells, 0);
  const std::vector<double> expected(cells, static_cast<double>(seeds) / cells);
  for (std::size_t s = 0; s < seeds; ++s)
    ++counted[owen_scrambled(sobol(index, dimension), seed(s)) >> 24];
  return expect_counts(counted, expected);
}

TEST(OwenScrambling, EveryPointIsUniformOverSeeds) {
  const auto seed = [](std::size_t s) { return random_words({.seed = 3, .element = s})[0]; };
  for (int d = 0; d < sobol_dimensions; ++d)
    for (const std::uint32_t index : {0u, 1u, 7u, 255u, 4095u}) {
      const Verdict verdict = uniform_over_seeds(index, d, seed);
      EXPECT_TRUE(verdict) << verdict.text;
    }
  // Planted fault: odd seeds only turn the first binary digit always alike.
  EXPECT_FALSE(uniform_over_seeds(5, 1, [&](std::size_t s) { return seed(s) | 1u; }));
}

/// Where the maps have their corners and creases, the largest number below 1 that the
/// tracer makes, the largest double below 1, and a lattice.
std::vector<double> coordinates() {
  std::vector<double> u{0,
                        1 / word_range,
                        0.25,
                        std::nextafter(0.5, 0),
                        0.5,
                        std::nextafter(0.5, 1),
                        0.75,
                        1 - 1 / word_range,
                        std::nextafter(1.0, 0.0)};
  for (int i = 1; i < 40; ++i) u.push_back(i / 40.0);
  return u;
}

constexpr double ulp = std::numeric_limits<double>::epsilon() / 2;  // below 1

TEST(TriangleSampler, InvertsToTheSamePoint) {
  for (const double u : coordinates())
    for (const double v : coordinates()) {
      const Barycentric b = sample_triangle(u, v);
      EXPECT_GE(b.w0, 0);
      EXPECT_GE(b.w1, 0);
      EXPECT_GE(b.w2, 0);
      EXPECT_NEAR(b.w0 + b.w1 + b.w2, 1, 2 * ulp);
      const UnitSquare back = invert_triangle(b);
      EXPECT_NEAR(back.u, u, 2 * ulp);
      EXPECT_NEAR(back.v, v, 2 * ulp);
    }
}

TEST(CosineSampler, InvertsToTheSamePoint) {
  for (const double u : coordinates())
    for (const double v : coordinates()) {
      const Vec3 w = sample_cosine(u, v);
      EXPECT_GE(w.z, 0);
      EXPECT_NEAR(norm(w), 1, 4 * ulp);
      const UnitSquare back = invert_cosine(w);
      // Sine, cosine, arc tangent, hypotenuse and the products between: about 8 roundings.
      EXPECT_NEAR(back.u, u, 8 * ulp) << u << " " << v;
      EXPECT_NEAR(back.v, v, 8 * ulp) << u << " " << v;
    }
}

/// Area that the map gives to a unit of the square, by central differences.
template <class Map>
double stretch(Map&& map, double u, double v, double h) {
  const Vec3 du = (map(u + h, v) - map(u - h, v)) / (2 * h);
  const Vec3 dv = (map(u, v + h) - map(u, v - h)) / (2 * h);
  return norm(cross(du, dv));
}

// The density is the inverse of the map's Jacobian. Central differences of step h are off
// by h² times third derivatives (≤ 1000 here: they grow to the inverse square of the distance to
// the square's centre, of 0.03 at least) and by rounding / h.
TEST(Samplers, DensityIsTheInverseJacobian) {
  constexpr double h = 1e-5, tolerance = 1000 * h * h + 10 * ulp / h;
  const Vec3 a{1, 2, 3}, b{4, 2, 5}, c{0, 7, 1};
  const double area = norm(cross(b - a, c - a)) / 2;
  const auto on_triangle = [&](double u, double v) {
    const Barycentric w = sample_triangle(u, v);
    return a * w.w0 + b * w.w1 + c * w.w2;
  };
  for (int i = 1; i < 19; ++i)
    for (int j = 1; j < 19; ++j) {
      const double u = i / 20.0 + 0.013, v = j / 20.0 + 0.017;  // off the creases
      EXPECT_NEAR(stretch(on_triangle, u, v, h) * triangle_pdf(area), 1, tolerance);
      const double pdf = cosine_pdf(sample_cosine(u, v).z);
      EXPECT_NEAR(stretch(sample_cosine, u, v, h) * pdf, 1, tolerance) << u << " " << v;
      // Planted fault: a density off by 2 %.
      EXPECT_GT(std::abs(stretch(sample_cosine, u, v, h) * 1.02 * pdf - 1), tolerance);
    }
  EXPECT_EQ(cosine_pdf(-0.5), 0);
}

}  // namespace
}  // namespace sunload::test
