// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// Sensors on surfaces: their rays begin off them, whichever way they look.

#include "solver/surface/sensor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "geo/base/units.h"
#include "solver/surface/ray_caster.h"
#include "tests/support/scenes.h"

namespace sunload::test {
namespace {

/// A house of 10 × 10 × 8 m on a ground of 200 m.
Scene house_on_ground() {
  SceneBuilder builder;
  const int grey = builder.material({"grey", 0.2, 0, 0});
  builder.quad({-100, -100, 0}, {100, -100, 0}, {100, 100, 0}, {-100, 100, 0}, grey);
  builder.box({0, 0, 0}, {10, 10, 8}, grey, SceneBuilder::Facing::outward);
  return builder.scene();
}

/// Where the rays of a sensor begin.
Vec3 seen_from(const Mesh& mesh, Vec3 at, Vec3 normal) {
  std::vector<Sensor> sensors{sensor_at(at, normal)};
  clear_of_surfaces(mesh, sensors);
  return sensors[0].position + sensors[0].normal * ray_offset_m(mesh);
}

TEST(Sensors, SeeFromWhereTheyStandInTheOpen) {
  const Scene scene = house_on_ground();
  const Vec3 at{-3, 2.5, 1.5};
  EXPECT_LT(norm(seen_from(scene.mesh, at, {1, 0, 0}) - at), 1e-12);
}

TEST(Sensors, OnASurfaceThatTheyFaceBeginAsPatchesDo) {
  const Scene scene = house_on_ground();
  std::vector<Sensor> sensors{sensor_at({30, 20, 0}, {0, 0, 1}), sensor_at({0, 5, 2}, {-1, 0, 0})};
  const auto before = sensors;
  clear_of_surfaces(scene.mesh, sensors);
  for (std::size_t s = 0; s < sensors.size(); ++s)
    EXPECT_EQ(sensors[s].position, before[s].position) << s;
}

TEST(Sensors, ThatLookAlongASurfaceBeginOffIt) {
  const Scene scene = house_on_ground();
  const double offset = ray_offset_m(scene.mesh);
  struct Case {
    Vec3 at, normal, surface;
  };
  for (const auto& [at, normal, surface] :
       {Case{{30, 20, 0}, {0, -1, 0}, {0, 0, 1}},       // along the ground
        Case{{30, 20, 0}, {0, -1, -1e-4}, {0, 0, 1}},   // a little into it, by a rounding
        Case{{30, 20, 0}, {0, -0.8, -0.6}, {0, 0, 1}},  // down to it
        Case{{0, 5, 2}, {0, 0, 1}, {-1, 0, 0}},         // up a wall
        Case{{5, 5, 8}, {1, 0, 0}, {0, 0, 1}},          // along a roof
        Case{{10, 5, 8}, {1, 0, 0}, {0, 0, 1}}}) {      // on its edge
    const Vec3 from = seen_from(scene.mesh, at, normal);
    EXPECT_GE(dot(from - at, surface), offset * 0.99) << norm(from - at) / offset;
    EXPECT_LE(norm(from - at), 4 * offset);
  }
}

TEST(Sensors, InACornerBeginOffBothOfItsSurfaces) {
  const Scene scene = house_on_ground();
  const double offset = ray_offset_m(scene.mesh);
  const Vec3 at{0, 5, 0};  // where the west wall meets the ground
  for (const Vec3 normal : {Vec3{0, -1, 0}, Vec3{-1, 0, 0}, Vec3{0, 0, 1}}) {
    const Vec3 from = seen_from(scene.mesh, at, normal);
    EXPECT_LE(from.x, -0.99 * offset);
    EXPECT_GE(from.z, 0.99 * offset);
  }
}

TEST(Sensors, InAnAcuteCornerBeginOffBothOfItsSurfaces) {
  SceneBuilder builder;
  const int grey = builder.material({"grey", 0.2, 0, 0});
  const double angle = radians(20), rise = std::tan(angle);
  builder.quad({-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}, grey);
  builder.quad({-5, -5, 0}, {-5, 5, 0}, {5, 5, 10 * rise}, {5, -5, 10 * rise}, grey);  // looks down
  const Scene scene = builder.scene();
  const double offset = ray_offset_m(scene.mesh);
  const Vec3 down{std::sin(angle), 0, -std::cos(angle)}, edge{-5, 0, 0};
  for (const Vec3 normal : {Vec3{0, 1, 0}, Vec3{1, 0, 0}, normalized(Vec3{1, 0, 0.2})}) {
    const Vec3 from = seen_from(scene.mesh, edge, normal);
    EXPECT_GE(from.z, 0.99 * offset);
    EXPECT_GE(dot(from - edge, down), 0.99 * offset);
  }
}

TEST(Sensors, BetweenSurfacesBackToBackBeginOffThem) {
  SceneBuilder builder;
  const int grey = builder.material({"grey", 0.2, 0, 0});
  builder.quad({-5, 0, 0}, {5, 0, 0}, {5, 0, 5}, {-5, 0, 5}, grey);  // front to -y
  builder.quad({-5, 0, 0}, {-5, 0, 5}, {5, 0, 5}, {5, 0, 0}, grey);  // front to +y
  const Scene scene = builder.scene();
  EXPECT_GE(std::abs(seen_from(scene.mesh, {0, 0, 2}, {1, 0, 0}).y),
            0.99 * ray_offset_m(scene.mesh));
}

TEST(Sensors, OnASheetAreOnTheSideThatTheyLookTo) {
  SceneBuilder builder;
  const int grey = builder.material({"grey", 0.2, 0, 0});
  builder.sides(Sides::two);
  builder.quad({-5, 0, 0}, {5, 0, 0}, {5, 0, 5}, {-5, 0, 5}, grey);  // front to -y
  const Mesh& mesh = builder.scene().mesh;
  EXPECT_GT(seen_from(mesh, {0, 0, 2}, {0.99, 0.1, 0}).y, 0);
  EXPECT_LT(seen_from(mesh, {0, 0, 2}, {0.99, -0.1, 0}).y, 0);
}

TEST(Sensors, ThatLookIntoABodyStayInIt) {
  const Scene scene = house_on_ground();
  EXPECT_GT(seen_from(scene.mesh, {0, 5, 2}, {1, 0, 0}).x, 0);
}

}  // namespace
}  // namespace sunload::test
