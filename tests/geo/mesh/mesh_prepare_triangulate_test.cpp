// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "geo/base/units.h"
#include "tests/geo/mesh/mesh_prepare_models.h"

namespace sunload::test {
namespace {

constexpr double triangulate_rounding = 1e-12;  // relative, of sums over some hundred products

/// A frame that is nowhere parallel to an axis, and a shift.
Vec3 tilted(Vec3 p) {
  const Vec3 n = normalized(Vec3{1, 2, 3});
  const auto frame = tangents(n);
  return p.x * frame.tangent + p.y * frame.bitangent + p.z * n + Vec3{3, -7, 11};
}

PreparedMesh alone(const std::vector<std::vector<Vec3>>& rings) {
  return ModelBuilder().object("p").polygon(rings).prepared();
}

std::vector<Vec3> circle(double radius, int n, Vec3 centre = {}) {
  std::vector<Vec3> ring;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * pi * i / n;
    ring.push_back(centre + Vec3{radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  return ring;
}

TEST(Triangulate, ConcaveShapesKeepTheirAreaInAnyAttitude) {
  const std::vector<Vec3> l_shape{{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
  const std::vector<Vec3> arrow{{0, 0, 0}, {2, -2, 0}, {1, 0, 0}, {2, 2, 0}};  // concave quad
  for (const auto& [ring, truth] : {std::pair(l_shape, 6.0), std::pair(arrow, 2.0)}) {
    for (const bool is_tilted : {false, true}) {
      for (const bool is_reversed : {false, true}) {
        std::vector<Vec3> points = ring;
        if (is_tilted) std::transform(ring.begin(), ring.end(), points.begin(), tilted);
        if (is_reversed) std::reverse(points.begin(), points.end());
        const auto p = alone({points});
        EXPECT_NEAR(area(p.mesh), truth, triangulate_rounding);
        EXPECT_EQ(p.mesh.triangle_count(), ring.size() - 2);
        EXPECT_EQ(p.mesh.vertices.size(), ring.size());
        // Fronts stay fronts: the area vectors add up to the ring's own.
        Vec3 sum;
        for (std::size_t t = 0; t < p.mesh.triangle_count(); ++t) {
          sum += p.mesh.area_vector2(t) / 2;
        }
        Vec3 n = is_tilted ? normalized(Vec3{1, 2, 3}) : Vec3{0, 0, 1};
        if (is_reversed) n = -n;
        EXPECT_NEAR(dot(sum, n), truth, triangulate_rounding);
        EXPECT_EQ(p.report.polygons_crossing + p.report.polygons_nonplanar, 0u);
      }
    }
  }
}

TEST(Triangulate, HolesStayOpenWhateverTheirWinding) {
  const auto outer = circle(10, 64);
  auto hole_1 = circle(2, 16, {4, 0, 0}), hole_2 = circle(1, 8, {-5, 1, 0});
  std::reverse(hole_1.begin(), hole_1.end());
  const auto polygon_area = [](int n, double r) { return n * r * r * std::sin(2 * pi / n) / 2; };
  const double truth = polygon_area(64, 10) - polygon_area(16, 2) - polygon_area(8, 1);
  for (const bool is_tilted : {false, true}) {
    std::vector<std::vector<Vec3>> rings{outer, hole_1, hole_2};
    if (is_tilted) {
      for (auto& ring : rings) std::transform(ring.begin(), ring.end(), ring.begin(), tilted);
    }
    const auto p = alone(rings);
    EXPECT_NEAR(area(p.mesh) / truth, 1, triangulate_rounding);
    EXPECT_EQ(p.report.polygons_with_holes, 1u);
    EXPECT_EQ(p.report.polygons_crossing, 0u);
    // Euler: a disc with h holes and v vertices has v + 2h - 2 triangles.
    EXPECT_EQ(p.mesh.triangle_count(), 64u + 16 + 8 + 2 * 2 - 2);
  }
}

TEST(Triangulate, ABridgeToAHoleIsNoBoundary) {
  // One ring that walks to the hole and back on the same edge.
  const auto p = alone({{{0, 0, 0},
                         {4, 0, 0},
                         {4, 4, 0},
                         {0, 4, 0},
                         {0, 0, 0},
                         {1, 1, 0},
                         {1, 3, 0},
                         {3, 3, 0},
                         {3, 1, 0},
                         {1, 1, 0}}});
  EXPECT_NEAR(area(p.mesh), 12, triangulate_rounding);
  EXPECT_EQ(p.report.polygons_crossing, 0u);
}

TEST(Triangulate, ABridgeInPiecesIsNoBoundaryEither) {
  // There in one edge, back in two.
  const auto p = alone({{{0, 0, 0},
                         {4, 0, 0},
                         {4, 4, 0},
                         {0, 4, 0},
                         {0, 0, 0},
                         {1, 1, 0},
                         {1, 3, 0},
                         {3, 3, 0},
                         {3, 1, 0},
                         {1, 1, 0},
                         {0.5, 0.5, 0}}});
  EXPECT_NEAR(area(p.mesh), 12, triangulate_rounding);
}

TEST(Triangulate, HolesMayTouchTheOuterRing) {
  // Half of the square is a hole that shares an edge with it.
  const auto p = alone(
      {{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, {{0, 0, 0}, {0, 2, 0}, {1, 2, 0}, {1, 0, 0}}});
  EXPECT_NEAR(area(p.mesh), 2, triangulate_rounding);
  const auto q =
      alone({{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, {{0, 0, 0}, {2, 1, 0}, {1, 2, 0}}});
  EXPECT_NEAR(area(q.mesh), 16 - 1.5, triangulate_rounding);
}

TEST(Triangulate, CrossingRingsAreFilledAndCounted) {
  const auto p =
      alone({{{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 1, 0}}});  // not symmetric: has a normal
  EXPECT_EQ(p.report.polygons_crossing, 1u);
  EXPECT_GT(p.mesh.triangle_count(), 0u);
  for (const auto& v : p.mesh.vertices) EXPECT_NEAR(v.z, 0, triangulate_rounding);
  // The diagonal y = x meets y = 1 - x/2 at x = 2/3: triangles of area 1/3 and 4/3.
  EXPECT_NEAR(area(p.mesh), 1.0 / 3 + 4.0 / 3, triangulate_rounding);
  EXPECT_NE(p.report.warnings[0].find("even-odd"), std::string::npos);
}

TEST(Triangulate, AHoleOutsideItsPolygonAddsNoArea) {
  const auto p = alone(
      {{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, {{5, 0, 0}, {6, 0, 0}, {6, 1, 0}, {5, 1, 0}}});
  EXPECT_NEAR(area(p.mesh), 16, triangulate_rounding);
  EXPECT_EQ(p.report.polygons_crossing, 1u);
}

TEST(Triangulate, PointsOnALineMakeNoSlivers) {
  std::vector<Vec3> ring;
  for (int i = 0; i <= 20; ++i) ring.push_back({i * 0.1, 0, 0});
  for (int i = 0; i <= 20; ++i) ring.push_back({2, i * 0.05, 0});
  ring.push_back({0, 1, 0});
  for (const bool is_tilted : {false, true}) {
    auto points = ring;
    if (is_tilted) std::transform(ring.begin(), ring.end(), points.begin(), tilted);
    const auto p = alone({points});
    EXPECT_NEAR(area(p.mesh), 2, triangulate_rounding);
    EXPECT_LT(p.report.worst_aspect, 100);
    EXPECT_EQ(p.report.degenerates_dropped, 0u);
  }
}

TEST(Triangulate, SlightlyFoldedRingsKeepTheirCornersAndAreCounted) {
  auto ring = circle(5, 12);
  ring[3].z += 0.05;
  const auto p = alone({ring});
  EXPECT_EQ(p.report.polygons_nonplanar, 1u);
  EXPECT_EQ(p.report.polygons_crossing, 0u);
  EXPECT_EQ(p.mesh.triangle_count(), 10u);
  ring[3].z -= 0.049;  // 1 mm: as files with three decimals are
  EXPECT_EQ(alone({ring}).report.polygons_nonplanar, 0u);
}

TEST(Triangulate, NothingThatCanBeDrawnAborts) {
  // Random closed scribbles: crossings, touching corners, repeated and collinear points.
  std::uint32_t state = 1;
  const auto next = [&] { return (state = state * 1664525u + 1013904223u) >> 16; };
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<std::vector<Vec3>> rings(1 + next() % 3);
    for (auto& ring : rings) {
      const auto n = 3 + next() % 12;
      for (std::uint32_t i = 0; i < n; ++i) {
        ring.push_back({static_cast<double>(next() % 5), static_cast<double>(next() % 5),
                        next() % 4 == 0 ? static_cast<double>(next() % 3) : 0.0});
      }
    }
    auto builder = ModelBuilder().object("p").polygon(rings).box({9, 9, 9}, {10, 10, 10});
    const auto p = builder.prepared();
    EXPECT_TRUE(std::isfinite(area(p.mesh)));
    EXPECT_EQ(p.report.polygons_untriangulated, 0u);
  }
}

TEST(Triangulate, APrismWithAShaftHasItsVolumeFromPolygonsWithHoles) {
  // As a CityJSON solid: top and bottom are polygons with a hole, the shaft's walls face inward.
  const auto outer = circle(6, 6), inner = circle(2, 5, {0.5, -0.25, 0});
  const double height = 9.5, n6 = 6 * 36 * std::sin(2 * pi / 6) / 2,
               n5 = 5 * 4 * std::sin(2 * pi / 5) / 2;
  const auto lifted = [](std::vector<Vec3> ring, double z) {
    for (auto& p : ring) p.z = z;
    return ring;
  };
  const auto back = [](std::vector<Vec3> ring) {
    std::reverse(ring.begin(), ring.end());
    return ring;
  };
  for (const Vec3 shift : {Vec3{}, Vec3{2678219.19, 1243078.72, 395.79}}) {
    auto builder = ModelBuilder().object("house", "Building").city();
    builder.polygon({lifted(outer, height), back(lifted(inner, height))});
    builder.polygon({back(outer), inner});
    for (const auto& [ring, is_inner] : {std::pair(outer, false), std::pair(inner, true)}) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec3 a = ring[i], b = ring[(i + 1) % ring.size()], up{0, 0, height};
        std::vector<Vec3> wall{a, b, b + up, a + up};
        builder.ring(is_inner ? back(wall) : wall);
      }
    }
    builder.moved([&](Vec3 p) { return p + shift; });
    const auto p = builder.prepared();
    EXPECT_EQ(p.report.closed_bodies, 1u);
    EXPECT_EQ(p.report.triangles_flipped, 0u);
    EXPECT_NEAR(p.report.volume_m3 / ((n6 - n5) * height), 1, 1e-9);  // the file's last bits
    EXPECT_NEAR(area_of(p, Surface::roof) / (n6 - n5), 1, 1e-9);
    EXPECT_NEAR(area_of(p, Surface::floor) / (n6 - n5), 1, 1e-9);
  }
}

// A rectangle with two corners exchanged: its lobes are alike, and their area vectors cancel each
// other out but for rounding, wherever it lies; of coordinates in millimetres, too.
TEST(Triangulate, LobesOfEqualAreaAreFilled) {
  const Vec3 normal{-0.5, 0, std::sqrt(0.75)};  // of a roof of 30 degrees
  for (const double turn : {0.0, 0.1, 0.4, 1.9})
    for (const double away : {0.0, 500000.0})
      for (const double grid_m : {1e-9, 1e-3}) {
        const auto at = [&](double x, double y) {
          const double u = x * std::cos(turn) - y * std::sin(turn),
                       v = x * std::sin(turn) + y * std::cos(turn);
          const auto on_grid = [&](double c) { return std::round(c / grid_m) * grid_m; };
          return Vec3{away + on_grid(u * normal.z), away + on_grid(v), on_grid(3 - u * normal.x)};
        };
        const auto p = ModelBuilder()
                           .object("roof")
                           .ring({at(0, 0), at(10, 10), at(10, 0), at(0, 10)})
                           .prepared();
        EXPECT_EQ(p.report.polygons_crossing, 1u) << turn << " " << away << " " << grid_m;
        EXPECT_EQ(p.report.degenerates_dropped, 0u) << turn << " " << away << " " << grid_m;
        Vec3 area;
        for (std::size_t t = 0; t < p.mesh.triangle_count(); ++t)
          area += p.mesh.area_vector2(t) / 2;
        EXPECT_NEAR(norm(area), 50, 50 * grid_m) << turn << " " << away << " " << grid_m;
        EXPECT_NEAR(std::abs(dot(area, normal)), norm(area), 50 * grid_m) << turn << " " << away;
      }
}

// There and back again.
TEST(Triangulate, RingsWithoutAreaAreCounted) {
  const auto p = ModelBuilder()
                     .object("roof")
                     .ring({{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {4, 0, 0}})
                     .ring({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}})
                     .prepared();
  EXPECT_EQ(p.report.degenerates_dropped, 1u);
  EXPECT_EQ(p.mesh.triangle_count(), 1u);
}

}  // namespace
}  // namespace sunload::test
