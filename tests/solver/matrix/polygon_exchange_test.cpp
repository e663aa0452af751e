// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/matrix/polygon_exchange.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "geo/base/units.h"

namespace sunload::test {
namespace {

using Square = std::array<Vec3, 4>;

/// Of the squares' halves, whose edges touch in all ways.
double by_triangles(const Square& from, const Square& to) {
  double sum = 0;
  for (const std::size_t a : {1u, 2u})
    for (const std::size_t b : {1u, 2u})
      sum += exchange_area(std::array{from[0], from[a], from[a + 1]},
                           std::array{to[0], to[b], to[b + 1]});
  return sum;
}

constexpr Square floor_of{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
constexpr double good = 1e-6;  // what the header promises

/// Howell, A catalog of radiation heat transfer configuration factors, C-11.
double of_parallel_squares(double distance) {
  const double x = 1 / distance, q = std::sqrt(1 + x * x);
  return 2 / (pi * x * x) *
         (std::log(q * q / std::sqrt(1 + 2 * x * x)) + 2 * x * q * std::atan(x / q) -
          2 * x * std::atan(x));
}

TEST(PolygonExchange, OfParallelSquaresIsThatOfTheCatalogue) {
  for (const double z : {0.05, 0.3, 1.0, 10.0, 300.0}) {
    const Square ceiling{{{0, 0, z}, {0, 1, z}, {1, 1, z}, {1, 0, z}}};
    const double truth = of_parallel_squares(z);
    // The catalogue's formula itself loses digits at 300: its terms are 1e5 times the result.
    const double limit = z > 100 ? 1e-5 : good;
    EXPECT_NEAR(exchange_area(floor_of, ceiling), truth, limit * truth) << z;
    EXPECT_NEAR(by_triangles(floor_of, ceiling), truth, limit * truth) << z;
  }
}

TEST(PolygonExchange, OfSquaresWithACommonEdgeIsThatOfTheCatalogue) {
  const Square wall{{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}};  // faces +x
  constexpr double truth = 0.20004377607540316;                     // C-14, H = W = 1
  EXPECT_NEAR(exchange_area(floor_of, wall), truth, good * truth);
  EXPECT_NEAR(by_triangles(floor_of, wall), truth, good * truth);
  EXPECT_NEAR(exchange_area(wall, floor_of), truth, good * truth);
}

TEST(PolygonExchange, DoesNotDependOnPlaceAndGrowsWithTheArea) {
  const auto moved = [](Square square, double scale) {
    for (Vec3& corner : square) corner = corner * scale + Vec3{3e4, -2e4, 500};
    return square;
  };
  const Square wall{{{-0.2, 0, 0.3}, {-0.2, 1, 0.3}, {-0.2, 1, 1}, {-0.2, 0, 1}}};
  const double here = exchange_area(floor_of, wall);
  EXPECT_NEAR(exchange_area(moved(floor_of, 7), moved(wall, 7)), 49 * here, 49 * good * here);
}

// Corners of one inclined plane, rounded to micrometres: what lies before the other's plane are
// slivers with edges shorter than what logarithms of 1 are known to. It must come to an end.
TEST(PolygonExchange, OfSurfacesOfOnePlaneButForRoundingIsNothing) {
  using Triangle = std::array<Vec3, 3>;
  constexpr Vec3 a{0.118779, 0, 0}, b{0.118779, 0.144830, 0.250856},
      c{0.187049, 0.144830, 0.250856}, d{0.187049, 0, 0}, e{1.378008, 0.144830, 0.250856},
      f{1.378008, 0.779360, 1.349895}, g{1.585768, 0.779360, 1.349895},
      h{1.585768, 0.144830, 0.250856};
  const auto normal = [](const Triangle& t) { return normalized(cross(t[1] - t[0], t[2] - t[0])); };
  constexpr double touch_m = 2.2e-9;  // as form factors of a scene of this size have it
  std::size_t facing = 0;
  for (const Triangle& s :
       {Triangle{a, b, c}, Triangle{a, c, d}, Triangle{a, b, d}, Triangle{b, c, d}})
    for (const Triangle& t :
         {Triangle{e, f, g}, Triangle{e, g, h}, Triangle{e, f, h}, Triangle{f, g, h}}) {
      const auto from = in_front(s, t[0], normal(t), touch_m),
                 to = in_front(t, s[0], normal(s), touch_m);
      if (from.empty() || to.empty()) continue;
      ++facing;
      EXPECT_NEAR(exchange_area(from, to), 0, 1e-9);
    }
  EXPECT_GT(facing, 0u);
}

TEST(PolygonExchange, CutsWhatIsBehindAPlane) {
  const auto half = in_front(floor_of, {0.5, 0, 0}, {1, 0, 0}, 1e-9);
  ASSERT_EQ(half.size(), 4u);
  for (const Vec3& corner : half) EXPECT_GE(corner.x, 0.5);
  EXPECT_TRUE(in_front(floor_of, {1, 0, 0}, {1, 0, 0}, 1e-9).empty()) << "touches the plane only";
  EXPECT_EQ(in_front(floor_of, {0, 0, 0}, {1, 0, 0}, 1e-9).size(), 4u);
}

}  // namespace
}  // namespace sunload::test
