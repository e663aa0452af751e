// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/base/spherical_triangle.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "geo/base/units.h"

namespace sunload {
namespace {

/// Directions at the middles of n × n cells of the unit square.
template <class Visit>
void for_each_direction(const SphericalTriangle& triangle, int n, Visit&& visit) {
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) visit(triangle.sample((i + 0.5) / n, (j + 0.5) / n));
}

TEST(SphericalTriangle, AnOctantIsAnEighthOfTheSphere) {
  const SphericalTriangle octant({2, 0, 0}, {0, 5, 0}, {0, 0, 0.1});
  EXPECT_NEAR(octant.solid_angle(), pi / 2, 1e-14);
}

// Far away it is area cosθ / r², however small; a lamp that nearly touches sees half of all.
TEST(SphericalTriangle, IsRightFromTinyToHalfASpace) {
  const double far = 1e5;
  const SphericalTriangle tiny({0, 0, far}, {0.5, 0, far}, {0, 0.5, far});
  EXPECT_NEAR(tiny.solid_angle(), 0.125 / (far * far), 1e-6 * 0.125 / (far * far));
  const double near = 1e-6;
  const SphericalTriangle half({-1, -1, near}, {2, -1, near}, {-1, 2, near});
  EXPECT_NEAR(half.solid_angle(), 2 * pi, 1e-4);
}

// By the divergence theorem the mean of the directions is known: Σ edges' arcs · normals / 2
// (Lambert's formula of the vector irradiance). Uniform directions have it, others have not.
TEST(SphericalTriangle, ItsDirectionsAreUniformAndWithin) {
  const std::array<std::array<Vec3, 3>, 3> triangles{
      {{Vec3{1, 0.2, 0.1}, Vec3{-0.3, 1, 0.4}, Vec3{0.1, -0.2, 1}},
       {Vec3{1, 0, 3}, Vec3{-1, 0.5, 3}, Vec3{0.2, 2, 1}},
       {Vec3{0.01, 0, 1}, Vec3{0, 0.04, 1}, Vec3{0, 0, 1}}}};
  for (const auto& corners : triangles)
    for (const bool turned : {false, true}) {
      const auto& [a, b, c] = corners;
      const SphericalTriangle triangle =
          turned ? SphericalTriangle(a, c, b) : SphericalTriangle(a, b, c);
      Vec3 truth{0, 0, 0};
      const double sense = dot(a, cross(b, c)) > 0 ? 1 : -1;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 p = normalized(corners[k]), q = normalized(corners[(k + 1) % 3]);
        const Vec3 across = cross(p, q);
        truth += across * (sense * std::atan2(norm(across), dot(p, q)) / (2 * norm(across)));
      }
      Vec3 sum{0, 0, 0};
      constexpr int n = 200;
      for_each_direction(triangle, n, [&](Vec3 w) {
        EXPECT_NEAR(norm(w), 1, 1e-12);
        for (std::size_t k = 0; k < 3; ++k)
          EXPECT_GT(sense * dot(w, cross(corners[k], corners[(k + 1) % 3])), -1e-12);
        sum += w;
      });
      const Vec3 mean = sum * (triangle.solid_angle() / (n * n));
      // Of the midpoint rule on n × n cells.
      EXPECT_NEAR(norm(mean - truth), 0, 1e-4 * norm(truth)) << turned;
      // Uniform points of the plane triangle would not do.
      Vec3 by_plane{0, 0, 0};
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const double root = std::sqrt((i + 0.5) / n), v = (j + 0.5) / n;
          by_plane += normalized(a * (1 - root) + b * (root * (1 - v)) + c * (root * v));
        }
      if (triangle.solid_angle() > 0.1) {
        EXPECT_GT(norm(by_plane * (triangle.solid_angle() / (n * n)) - truth), 1e-2 * norm(truth));
      }
    }
}

}  // namespace
}  // namespace sunload
