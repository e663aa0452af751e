// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Faces cut along planes: nothing is lost, all parts lie on one side, and bodies stay closed.
#include "geo/mesh/cut_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "geo/mesh/covers.h"
#include "tests/geo/mesh/mesh_prepare_models.h"

namespace sunload::test {
namespace {

constexpr double rounding_of_cuts = 1e-9;  // m2, of areas of some hundred

/// Of triangles that are wholly beyond a plane; every one must be on one side.
double area_beyond(const Mesh& mesh, const FacePlane& plane) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    double low = infinity, high = -infinity;
    for (int k = 0; k < 3; ++k) {
      const double beyond = dot(plane.normal, mesh.corner(t, k)) - plane.offset;
      low = std::min(low, beyond);
      high = std::max(high, beyond);
    }
    EXPECT_FALSE(low < -contact_of(mesh) && high > contact_of(mesh)) << "triangle " << t;
    if (low + high > 0) sum += mesh.area_m2(t);
  }
  return sum;
}

void expect_whole_and_closed(const PreparedMesh& cut, double area_m2, double volume_m3) {
  EXPECT_NEAR(area(cut.mesh), area_m2, rounding_of_cuts);
  EXPECT_EQ(cut.bodies.triangle_body.size(), cut.mesh.triangle_count());
  Mesh again = cut.mesh;
  const Bodies bodies =
      orient(again, std::vector<std::uint8_t>(again.triangle_count(), 0), Winding::keep);
  EXPECT_EQ(bodies.open_edges, 0u);
  EXPECT_EQ(bodies.nonmanifold_edges, 0u);
  ASSERT_EQ(bodies.bodies.size(), 1u);
  EXPECT_NEAR(bodies.bodies.front().volume, volume_m3, rounding_of_cuts);
}

/// All triangles may be cut.
std::vector<std::size_t> cut_all(PreparedMesh& of, const PlaneOfFace& plane_of) {
  std::vector<std::size_t> all(of.mesh.triangle_count());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return cut_faces(of.mesh, of.bodies, all, std::array{plane_of});
}

PreparedMesh house() {
  return ModelBuilder().object("house").box({0, 0, 0}, {10, 8, 6}).prepared();
}
constexpr double area_of_house = 2 * (10 * 8 + 10 * 6 + 8 * 6), volume_of_house = 10 * 8 * 6;

TEST(CutFaces, AtAHeightWallsHaveTwoParts) {
  PreparedMesh cut = house();
  FacePlane plane;
  plane.offset = 4;
  const std::size_t before = cut.mesh.triangle_count();
  const auto source = cut_all(cut, [&](std::size_t) { return plane; });
  EXPECT_EQ(source.size(), cut.mesh.triangle_count());
  EXPECT_GT(source.size(), before);
  expect_whole_and_closed(cut, area_of_house, volume_of_house);
  EXPECT_NEAR(area_beyond(cut.mesh, plane), 2 * (10 + 8) * 2 + 80, rounding_of_cuts);
}

TEST(CutFaces, SlantingPlanesOfTheirOwnCutEveryTriangle) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int trial = 0; trial < 20; ++trial) {
    PreparedMesh cut = house();
    std::vector<FacePlane> planes(cut.mesh.triangle_count());
    for (FacePlane& plane : planes) {
      plane.normal = normalized(Vec3{any(random), any(random), any(random)});
      plane.offset = dot(plane.normal, Vec3{5, 4, 3}) + any(random);
    }
    const auto source = cut_all(cut, [&](std::size_t t) { return planes[t]; });
    expect_whole_and_closed(cut, area_of_house, volume_of_house);
    for (std::size_t t = 0; t < source.size(); ++t) {
      const FacePlane& plane = planes[source[t]];
      double low = infinity, high = -infinity;
      for (int k = 0; k < 3; ++k) {
        const double beyond = dot(plane.normal, cut.mesh.corner(t, k)) - plane.offset;
        low = std::min(low, beyond);
        high = std::max(high, beyond);
      }
      EXPECT_FALSE(low < -contact_of(cut.mesh) && high > contact_of(cut.mesh));
    }
  }
}

TEST(CutFaces, OnlyWhatLiesBetweenTheEndsIsCut) {
  FacePlane plane;
  plane.normal = {0, 1, 0};
  plane.offset = 4;
  plane.along = {1, 0, 0};
  plane.from = 12;  // beyond the house
  plane.to = 20;
  PreparedMesh cut = house();
  const auto triangles = cut.mesh.triangles;
  cut_all(cut, [&](std::size_t) { return plane; });
  EXPECT_EQ(cut.mesh.triangles, triangles);
  plane.from = 9.5;  // the east wall, and what of top and bottom it meets
  cut_all(cut, [&](std::size_t) { return plane; });
  EXPECT_GT(cut.mesh.triangle_count(), triangles.size());
  expect_whole_and_closed(cut, area_of_house, volume_of_house);
  for (std::size_t t = 0; t < cut.mesh.triangle_count(); ++t) {
    const bool is_west = cut.mesh.corner(t, 0).x == 0 && cut.mesh.corner(t, 1).x == 0 &&
                         cut.mesh.corner(t, 2).x == 0;
    if (is_west) {
      EXPECT_NEAR(cut.mesh.area_m2(t), 24, rounding_of_cuts);
    }
  }
}

TEST(CutFaces, ThroughCornersAndAlongEdgesNothingIsCut) {
  FacePlane plane;
  PreparedMesh cut = house();
  const auto triangles = cut.mesh.triangles;
  for (const double height : {0.0, 1e-4, 6.0, 6.0 - 1e-4, 7.0}) {
    plane.offset = height;
    cut_all(cut, [&](std::size_t) { return plane; });
    EXPECT_EQ(cut.mesh.triangles, triangles) << height;
  }
}

// Planes one after the other, some triangles alone: these and what shares their edges are divided,
// all others are as they were, and parts of the mesh are those that come apart from it.
TEST(CutFaces, SomeTrianglesAlongOnePlaneAfterTheOther) {
  PreparedMesh cut = house();
  const Mesh before = cut.mesh;
  std::vector<std::size_t> roof;
  for (std::size_t t = 0; t < before.triangle_count(); ++t)
    if (before.normal(t).z > 0.5) roof.push_back(t);
  std::vector<PlaneOfFace> planes;
  for (const double x : {2.0, 5.0, 9.0})
    planes.push_back([x](std::size_t) {
      FacePlane plane;
      plane.normal = {1, 0, 0};
      plane.offset = x;
      return plane;
    });
  const FaceParts parts = parts_of_faces(before, roof, planes);
  const auto source = cut_faces(cut.mesh, cut.bodies, roof, planes);
  expect_whole_and_closed(cut, area_of_house, volume_of_house);
  double divided_m2 = 0, roof_m2 = 0;
  for (std::size_t t = 0; t < source.size(); ++t) {
    const bool is_roof = std::find(roof.begin(), roof.end(), source[t]) != roof.end();
    if (parts.is_divided[source[t]] == 0) {
      EXPECT_FALSE(is_roof);
      EXPECT_EQ(cut.mesh.triangles[t], before.triangles[source[t]]);
      continue;
    }
    divided_m2 += cut.mesh.area_m2(t);
    if (!is_roof) continue;
    roof_m2 += cut.mesh.area_m2(t);
    std::size_t strip = 0;
    const double middle = cut.mesh.point(t, 1.0 / 3, 1.0 / 3).x;
    for (const double x : {2.0, 5.0, 9.0}) strip += middle > x ? 1 : 0;
    constexpr std::array ends{0.0, 2.0, 5.0, 9.0, 10.0};
    for (int k = 0; k < 3; ++k) {
      EXPECT_GE(cut.mesh.corner(t, k).x, ends[strip] - rounding_of_cuts);
      EXPECT_LE(cut.mesh.corner(t, k).x, ends[strip + 1] + rounding_of_cuts);
    }
  }
  EXPECT_NEAR(roof_m2, 80, rounding_of_cuts);
  double of_parts = 0;
  for (std::size_t p = 0; p < parts.source.size(); ++p)
    if (parts.is_divided[parts.source[p]] != 0) of_parts += parts.mesh.area_m2(p);
  EXPECT_NEAR(of_parts, divided_m2, rounding_of_cuts);
}

}  // namespace
}  // namespace sunload::test
