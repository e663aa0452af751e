// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Corners on open edges: the search finds all of them, and does not look at all points to do so.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "geo/base/check.h"
#include "geo/mesh/point_tree.h"
#include "geo/mesh/t_joints.h"
#include "tests/geo/mesh/mesh_prepare_models.h"

namespace sunload {
namespace {

using test::area;
using test::area_of;
using test::ModelBuilder;

double distance_to_segment(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 edge = b - a;
  const double s = std::clamp(dot(p - a, edge) / dot(edge, edge), 0.0, 1.0);
  return norm(p - (a + edge * s));
}

/// Points of a lattice, in which many lie on lines through two others.
std::vector<Vec3> lattice_points(std::size_t count, int width, int depth, int height) {
  std::mt19937 random(7);
  const auto below = [&](int n) {
    return static_cast<double>(random() % static_cast<unsigned>(n));
  };
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = below(width), y = below(depth), z = below(height);
    points.push_back({x, y, z});
  }
  return points;
}

std::vector<std::int32_t> numbers(std::size_t count) {
  std::vector<std::int32_t> list(count);
  for (std::size_t i = 0; i < count; ++i) list[i] = static_cast<std::int32_t>(i);
  return list;
}

TEST(PointTree, FindsAllPointsNearASegment) {
  const auto points = lattice_points(1500, 60, 40, 4);
  const PointTree tree(points, numbers(points.size()));
  std::size_t near = 0;
  for (const double distance : {1e-6, 0.4, 3.0}) {
    for (std::size_t i = 0; i + 1 < points.size(); i += 7) {
      const Vec3 a = points[i], b = points[i + 1];
      if (a == b) continue;
      auto found = tree.near_segment(a, b, distance).points;
      std::sort(found.begin(), found.end());
      EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
      for (std::size_t v = 0; v < points.size(); ++v) {
        if (distance_to_segment(points[v], a, b) > distance) continue;
        ++near;
        EXPECT_TRUE(std::binary_search(found.begin(), found.end(), static_cast<std::int32_t>(v)));
      }
    }
  }
  EXPECT_GT(near, 1000u);
}

TEST(PointTree, NoPointsAndOnePoint) {
  const std::vector<Vec3> points{{1, 2, 3}};
  EXPECT_TRUE(PointTree(points, {}).near_segment({0, 0, 0}, {1, 1, 1}, 1).points.empty());
  const PointTree one(points, {0});
  EXPECT_EQ(one.near_segment({0, 2, 3}, {2, 2, 3}, 1e-9).points, std::vector<std::int32_t>{0});
  EXPECT_TRUE(one.near_segment({0, 5, 3}, {2, 5, 3}, 1e-9).points.empty());
}

/// Of points of a plane a line meets as many boxes as the root of their number: four times the
/// points are twice the cost, where looking at each of them would be four times.
TEST(PointTree, LongSegmentsCostTheRootOfThePoints) {
  const auto looks = [](std::size_t count) {
    const auto points = lattice_points(count, 1'000'000, 1'000'000, 1);
    const PointTree tree(points, numbers(count));
    std::size_t sum = 0;
    for (std::size_t i = 0; i < 500; ++i)
      sum += tree.near_segment(points[2 * i], points[2 * i + 1], 1e-4).looks;
    return sum;
  };
  EXPECT_LT(looks(64'000), 3 * looks(16'000));
}

/// Triangles of random corners, each edge used once.
Mesh overlapping(const std::vector<Vec3>& corners) {
  Mesh mesh;
  mesh.vertices = corners;
  mesh.object_names = {"heap"};
  mesh.object_kinds = {""};
  for (std::size_t v = 0; v + 2 < corners.size(); v += 3) {
    const auto first = static_cast<std::int32_t>(v);
    if (norm(cross(corners[v + 1] - corners[v], corners[v + 2] - corners[v])) == 0) continue;
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangle_object.push_back(make_id<ObjectId>(0));
    mesh.triangle_material.push_back(MaterialId::none());
    mesh.triangle_facade.push_back(FacadeId::none());
    mesh.triangle_surface.push_back(Surface::other);
    mesh.triangle_sides.push_back(Sides::one);
  }
  return mesh;
}

TEST(TJoints, AllCornersOnEdgesAreFound) {
  constexpr double tolerance = 1e-4;
  Mesh mesh = overlapping(lattice_points(900, 20, 12, 2));
  std::size_t expected = 0;
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 a = mesh.vertices[static_cast<std::size_t>(triangle[k])];
      const Vec3 b = mesh.vertices[static_cast<std::size_t>(triangle[(k + 1) % 3])];
      for (const auto& other : mesh.triangles) {
        for (const auto v : other) {
          const Vec3 p = mesh.vertices[static_cast<std::size_t>(v)];
          if (distance_to_segment(p, a, b) <= tolerance && norm(p - a) > tolerance &&
              norm(p - b) > tolerance)
            ++expected;
        }
      }
    }
  }
  const double before = area(mesh);
  const std::size_t triangles = mesh.triangle_count();
  EXPECT_GT(expected, 500u);
  EXPECT_EQ(split_t_joints(mesh, tolerance, "heap.obj"), expected);
  EXPECT_EQ(mesh.triangle_count(), triangles + expected);
  EXPECT_NEAR(area(mesh), before, 1e-9 * before);
}

/// Triangles that all stand on one line have n² corners on their edges.
TEST(TJoints, ThoseWithoutEndAreRefused) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 2000; ++i) {
    corners.push_back({i * 0.5, 0, 0});
    corners.push_back({5000.25 - i * 0.5, 0, 0});
    corners.push_back({i * 1.0, 1.0 + i, 0});
  }
  Mesh mesh = overlapping(corners);
  try {
    split_t_joints(mesh, 1e-4, "line.obj");
    FAIL() << "was split";
  } catch (const InputError& error) {
    const std::string text = error.what();
    for (const char* part :
         {"line.obj: too many triangles of object 'heap' overlap", "scene.repair: safe"})
      EXPECT_NE(text.find(part), std::string::npos) << text;
  }
}

/// Houses whose walls have corners in their edges that roofs, floors and neighbours have not.
ModelBuilder house_with_corners(bool has_floor, Vec3 off = {}) {
  ModelBuilder model;
  model.object("house");
  const auto faces = ModelBuilder::box_faces({0, 0, 0}, {10, 8, 6});
  for (std::size_t f = has_floor ? 0 : 1; f < faces.size(); ++f) {
    std::vector<Vec3> ring;
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3 a = faces[f][k], b = faces[f][(k + 1) % 4];
      ring.push_back(a);
      if (f >= 2 && (f + k) % 2 == 0) ring.push_back(0.75 * a + 0.25 * b + off);
    }
    model.ring(ring);
  }
  return model;
}

TEST(TJoints, ThatCloseAHouseAreSplit) {
  for (const bool has_floor : {true, false}) {
    const PreparedMesh p = house_with_corners(has_floor).prepared();
    EXPECT_EQ(p.report.closed_bodies, has_floor ? 1u : 0u);
    EXPECT_GT(p.report.t_joints_split, 0u);
    EXPECT_NEAR(area_of(p, Surface::roof), 80, 1e-9);
    EXPECT_NEAR(area_of(p, Surface::wall), 36 * 6, 1e-9);
    EXPECT_EQ(p.report.open_edges == 0, has_floor);
    // Rounded, by as much in this small scene as millimetres are in one of 100 m.
    const PreparedMesh r = house_with_corners(has_floor, {5e-5, -4e-5, 3e-5}).prepared();
    EXPECT_EQ(r.report.closed_bodies, has_floor ? 1u : 0u);
    EXPECT_NEAR(area_of(r, Surface::roof), 80, 0.02);
  }
}

TEST(TJoints, OfWhatStaysOpenAreNotSplit) {
  ModelBuilder broken = house_with_corners(true);
  auto& model = broken.model();
  ModelBuilder open;
  open.object("house");
  const auto faces = ModelBuilder::box_faces({0, 0, 0}, {10, 8, 6});
  for (std::size_t f = 0; f < 5; ++f) {  // no wall in the east
    std::vector<Vec3> ring(faces[f].begin(), faces[f].end());
    if (f >= 2) ring.insert(ring.begin() + 1, 0.5 * (ring[0] + ring[1]));
    open.ring(ring);
  }
  EXPECT_EQ(open.prepared().report.t_joints_split, 0u);
  PrepareRules all;
  all.repair = Repair::all;
  EXPECT_GT(open.prepared(all).report.t_joints_split, 0u);
  // A house of the same object that closes is split all the same.
  open.moved([](Vec3 v) { return v + Vec3{100, 0, 0}; });
  for (std::size_t p = 0; p < model.polygon_count(); ++p) {
    const auto ring = static_cast<std::size_t>(model.polygon_ring[p]);
    std::vector<Vec3> points;
    for (auto i = model.ring_begin[ring]; i < model.ring_begin[ring + 1]; ++i)
      points.push_back(
          model.vertices[static_cast<std::size_t>(model.ring_vertex[static_cast<std::size_t>(i)])]);
    open.ring(points);
  }
  const PreparedMesh p = open.prepared();
  EXPECT_EQ(p.report.closed_bodies, 1u);
  EXPECT_EQ(p.report.t_joints_split, broken.prepared().report.t_joints_split);
}

}  // namespace
}  // namespace sunload
