// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What the refinement takes the light load for, where it is known.

#include "solver/mesh/mesh_pilot.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace sunload::test {
namespace {

// An open plate between a sky and a ground that are alike sees H₀ from everywhere, and of every sun
// its exposure times the cosine, on the side that faces it.
TEST(MeshPilot, LoadOfAnOpenPlateIsThatOfItsSunsAndWhatIsAround) {
  constexpr double around = 30;
  const Vec3 normal = normalized({0.3, -0.5, 0.8});
  const Tangents plane = tangents(normal);
  SceneBuilder builder;
  builder.sides(Sides::two)
      .triangle({0, 0, 0}, plane.tangent * 3, plane.bitangent * 2,
                builder.material({"m", 0.3, 0, 0}));
  const Scene scene = builder.scene();
  const ElementForest forest(scene);
  const RayCaster caster(scene.mesh);
  PeriodLight light;
  light.sky.assign(static_cast<std::size_t>(SkyGrid().cell_count()), around);
  light.ground = around;
  // Two before the front, one of them all but grazing; one before the back.
  light.suns = {{normalized({0.1, -0.6, 0.4}), 100},
                {normalized({0.9, 0.5, 0.1}), 70},
                {normalized({-0.9, 0.3, 0.1}), 40}};
  const MeshPilot pilot(forest, scene, caster, light, 1);
  for (const std::uint8_t side : {std::uint8_t{0}, std::uint8_t{1}}) {
    const Vec3 n = side == 0 ? normal : -normal;
    double truth = around, without_cosine = around, largest_cosine = 0;
    for (const PeriodSun& sun : light.suns) {
      const double cos_theta = std::max(0.0, dot(n, sun.direction));
      truth += sun.exposure * cos_theta;
      without_cosine += cos_theta > 0 ? sun.exposure : 0;
      largest_cosine = std::max(largest_cosine, cos_theta);
    }
    const ElementLoad load = pilot.load(0, side, 0.01);
    EXPECT_NEAR(load.mean, truth, float_rounding * truth);
    EXPECT_NEAR(load.variance, 0, float_rounding * truth * truth);
    EXPECT_TRUE(load.sees_sun);
    EXPECT_NEAR(load.largest_cosine, largest_cosine, float_rounding);
    EXPECT_GT(without_cosine, 1.1 * truth);  // it would be seen
  }
}

// Of a beam that falls between the points of a large element: a spot of even light on the rest.
TEST(MeshPilot, SeesTheSpotOfANarrowBeam) {
  SceneBuilder builder;
  builder.triangle({-10, -10, 0}, {30, -10, 0}, {-10, 30, 0}, builder.material({"m", 0.3, 0, 0}));
  Scene scene = builder.scene();
  constexpr double half_deg = 0.5, height = 3;
  scene.luminaires.webs = {{{0}, {0, half_deg}, {1, 1}}};
  scene.luminaires.all = {Luminaire({0.4, -0.7, height}, {0, 0, -1}, 0)};
  const ElementForest forest(scene);
  const RayCaster caster(scene.mesh);
  PeriodLight light;
  light.sky.assign(static_cast<std::size_t>(SkyGrid().cell_count()), 0);
  light.lamp_time_s = 10;
  const MeshPilot pilot(forest, scene, caster, light, 1);
  const ElementLoad load = pilot.load(0, 0, 0.01);
  const double mean = light.lamp_time_s * scene.luminaires.flux() / forest.area(0);
  const double in_spot = light.lamp_time_s / (height * height);
  EXPECT_NEAR(load.mean, mean, 1e-3 * mean);
  EXPECT_NEAR(load.variance, mean * (in_spot - mean), 1e-3 * mean * in_spot);
}

}  // namespace
}  // namespace sunload::test
